use robot_model_examples::seed_004::{*, plant::*, rig::*, truth::*, device::*};
use robot_model::trace::*;
use robot_model::columns::Arm;
fn show(name: &str, v: &Verdict, t: std::time::Instant) {
    println!("{name}: {} {:?} turn {:?}", v.outcome, t.elapsed(), v.turn_speeds);
    for (w, f) in v.findings.iter().map(|f| ("finding", f)).chain(v.leads.iter().map(|f| ("lead", f))) {
        println!("  {w} {} on {:?} p {:.1e} held {:?} raw {:?} {:?}", f.kind, f.joints, f.evidence.p_value, f.evidence.held_out_percent, f.evidence.raw_percent, f.parameters.iter().map(|p| (p.name.clone(), p.value)).collect::<Vec<_>>());
    }
    for t in v.tried.iter().take(12) { println!("    tried {} {} {:?} p {:.1e} {:?} {:?}", t.round, t.kind, t.joints, t.evidence.p_value, t.shapes, t.refusals); }
    for l in &v.left { println!("    left {l:?}"); }
}
fn trace(name: &str, text: &str, log: &robot_model::log::Log) {
    let t = std::time::Instant::now();
    let arm = arm(text).unwrap();
    let und = arm.undeclared();
    let v = Trace::new(und.candidates()).run(&arm, std::slice::from_ref(log), &mut |_| ()).unwrap();
    show(name, &v, t);
}
fn main() {
    let which: Vec<String> = std::env::args().skip(1).collect();
    let motion = Sines::new(10, &ROOM, 4);
    let g: Vec<f64> = std::env::var("G").unwrap().split(",").map(|x| x.parse().unwrap()).collect(); let stiff = Gains::all(g[0], g[1]);
    let go = |c: usize, secs: f64| run(Plant::new(table_1(c), motion.at(0.0)[0]), &motion, &stiff, 4.0+secs, 5).unwrap().log("log", 4.0, 4.0+secs).unwrap();
    for w in which {
        match w.as_str() {
            "free" => trace("UR without friction", &without_friction(), &go(0, 30.0)),
            "full" => trace("UR full", SPEC, &go(0, 30.0)),
            "printed" => trace("GCW printed", PRINTED, &go(1, 30.0)),
            "printed4" => trace("USD+GCW printed", PRINTED, &go(4, 30.0)),
            "right" => trace("GCW right", SPEC, &go(1, 30.0)),
            "stribeck" => {
                let mut pi = table_1(0);
                pi[8] = 0.4e-3; pi[9] = 0.3e-3; pi[10] = 0.3e-3;
                let s = [0, 1, 2].map(|j| Stribeck { fs: g[2] * pi[11 + j], vs: g[3] });
                let log = run(Plant::new(pi, motion.at(0.0)[0]).with_stribeck(s), &motion, &stiff, 34.0, 5).unwrap().log("log", 4.0, 34.0).unwrap();
                let a = arm(SPEC).unwrap();
                let e = robot_model::identify::Identify::default().fit(&a, std::slice::from_ref(&log)).unwrap();
                println!("{e}");
                trace("Stribeck", SPEC, &log);
            }
            _ => {}
        }
        let _ = motion.at(0.0);
    }
}
#[allow(unused)] fn f(a: &dyn Arm) {}

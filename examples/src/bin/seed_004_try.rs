use robot_model_examples::seed_004::{fits, rig::*, tracing, truth::*, device::*, control, contact, shares};
fn main() {
    let motion = Sines::new(10, &ROOM, 4);
    let t = std::time::Instant::now();
    for c in 0..5 { println!("{:?}", shares::shares(c, &motion)); }
    println!("{:?} {:?} {:?} {:?}", shares::crossover(), shares::balance(0.075), shares::balance(shares::lever_of_print().unwrap()), shares::lever_of_print());
    println!("{:?}", t.elapsed());
    println!("J {:e}", contact::jacobian_off());
    let f = contact::felt(&table_1(2), &motion).unwrap();
    println!("felt {:?} {:?} {:?}", f.rms, f.frame_off, t.elapsed());
    for (c, g) in [(0, CONTROL_GAINS[0]), (0, CONTROL_GAINS[1]), (0, [100.0, 14.0]), (4, CONTROL_GAINS[2]), (4, CONTROL_GAINS[0])] {
        for known in [table_1(c), piece_wise()] {
            let s = control::square(&table_1(c), &known, g).unwrap();
            println!("{c} {g:?} ss {:.1} rms {:.4} os {:.1} {}", s.steady_percent, s.rms, s.overshoot_percent, s.is_stable);
        }
    }
    for c in 0..5 { println!("{c} largest {:?} {:?} {:?}", control::largest_gain(&table_1(c), &table_1(c)), control::largest_gain(&table_1(c), &piece_wise()), t.elapsed()); }
    for (f, s) in [(0.6, 0.2), (0.5, 0.3), (1.0, 0.3), (1.0, 0.6)] {
        let tr = tracing::falling(&motion, f, s).unwrap();
        println!("{f} {s} {} {:?} {:?}", tracing::said(&tr.0), tr.1, t.elapsed());
    }
}

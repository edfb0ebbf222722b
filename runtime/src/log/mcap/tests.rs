//! Bags that the reader takes, those that it asks about, and damaged ones.

#![expect(
    clippy::float_cmp,
    reason = "what is read is the number that was written, to the last bit"
)]

use std::collections::BTreeMap;
use std::io::Cursor;

use mcap::records::MessageHeader;
use mcap::{Compression, WriteOptions, Writer};

use super::super::{Column, Columns, Log, LogError};
use super::cdr::JointState;
use super::{JointStates, NotABag};

const SAMPLES: u32 = 1000;

/// A message at a sample: joints by name, in an order of its own.
fn message(k: u32, names: &[&str]) -> JointState {
    let sample = f64::from(k);
    JointState {
        seconds: 1_700_000_000 + i32::try_from(k / 500).expect("small"),
        nanoseconds: k % 500 * 2_000_000,
        names: names.iter().map(|name| (*name).to_owned()).collect(),
        positions: (0..names.len()).map(|j| sample + 0.25 * j as f64).collect(),
        velocities: vec![500.0; names.len()],
        efforts: (0..names.len())
            .map(|j| -sample - 0.25 * j as f64)
            .collect(),
        ..JointState::default()
    }
}

/// A topic, its type, and its message at a sample.
type Topic<'a> = (&'a str, &'a str, &'a dyn Fn(u32) -> Option<Vec<u8>>);

/// Topics, whose messages come in turns.
fn bag(options: WriteOptions, topics: &[Topic<'_>]) -> Vec<u8> {
    let options = options.compression_threads(0).chunk_size(Some(8192));
    let mut writer: Writer<_> = options.create(Cursor::new(Vec::new())).expect("a writer");
    let channels: Vec<u16> = topics
        .iter()
        .map(|(topic, kind, _)| {
            let schema = writer.add_schema(kind, "ros2msg", b"").expect("a schema");
            let channel = writer.add_channel(schema, topic, "cdr", &BTreeMap::new());
            channel.expect("a channel")
        })
        .collect();
    for k in 0..SAMPLES {
        for (&channel_id, (_, _, data)) in channels.iter().zip(topics) {
            let header = MessageHeader {
                channel_id,
                sequence: k,
                log_time: u64::from(k),
                publish_time: 0,
            };
            if let Some(data) = data(k) {
                let written = writer.write_to_known_channel(&header, &data);
                written.expect("a message");
            }
        }
    }
    writer.finish().expect("an end");
    writer.into_inner().into_inner()
}

const STATES: &str = "sensor_msgs/msg/JointState";

fn columns(joints: &[&str]) -> Columns {
    Columns {
        joints: joints.iter().map(|name| (*name).to_owned()).collect(),
        ..Columns::standard(joints.len())
    }
}

fn read(bag: &[u8], columns: &Columns) -> Result<Log, LogError> {
    Log::from_reader_as("run.mcap", bag, columns)
}

fn said(bag: &[u8], columns: &Columns) -> String {
    read(bag, columns).expect_err("it is refused").to_string()
}

/// The shoulder comes second in messages and first in the arm; a gripper and a camera publish beside it.
fn arm(options: WriteOptions) -> Vec<u8> {
    let states = |k| Some(message(k, &["elbow", "shoulder", "finger"]).write());
    let gripper = |k: u32| (k.is_multiple_of(3)).then(|| vec![7; 100]);
    bag(
        options,
        &[
            ("/camera", "sensor_msgs/msg/Image", &gripper),
            ("/joint_states", STATES, &states),
        ],
    )
}

#[test]
fn joints_are_found_by_name_however_the_bag_is_packed() {
    let packed = [
        WriteOptions::new().compression(Some(Compression::Zstd)),
        WriteOptions::new().compression(Some(Compression::Lz4)),
        WriteOptions::new().compression(None),
        WriteOptions::new().use_chunks(false),
        WriteOptions::new().emit_summary_records(false),
    ];
    let dir = std::env::temp_dir().join(format!("robot-model-mcap-{}", std::process::id()));
    std::fs::create_dir_all(&dir).expect("a folder");
    for options in packed {
        let bytes = arm(options);
        let log = read(&bytes, &columns(&["shoulder", "elbow"])).expect("a sound log");
        assert_eq!(
            (log.time.len(), log.time[1], log.time[999]),
            (1000, 0.002, 1.998)
        );
        assert_eq!((log.q[0][700], log.q[1][700]), (700.25, 700.0));
        assert_eq!((log.tau[0][700], log.tau[1][700]), (-700.25, -700.0));
        assert_eq!(log.dq[1][700], 500.0);
        assert!(
            log.extra.is_empty() && log.report.is_empty(),
            "{:?}",
            log.report
        );

        let file = dir.join("run.mcap");
        std::fs::write(&file, &bytes).expect("a file");
        let again = Log::read_as(&file, &columns(&["shoulder", "elbow"])).expect("a sound log");
        assert_eq!(
            (&again.time, &again.q, &again.tau),
            (&log.time, &log.q, &log.tau)
        );
        let pieces = Log::pieces(&file, &columns(&["shoulder", "elbow"]), 300, 0.02);
        let pieces: Vec<Log> = pieces
            .expect("a bag")
            .map(|piece| piece.expect("a piece"))
            .collect();
        assert_eq!((pieces.len(), pieces[1].q[1][0]), (3, 290.0));
    }
    std::fs::remove_dir_all(&dir).expect("the folder");
}

#[test]
fn what_is_written_is_read() {
    let time: Vec<f64> = (0..SAMPLES).map(|k| f64::from(k) / 250.0).collect();
    let wave = |rate: f64| time.iter().map(|t| (rate * t).sin()).collect::<Vec<f64>>();
    let (q, dq) = ([wave(1.0), wave(2.0)], [wave(3.0), wave(4.0)]);
    let joints = ["a".to_owned(), "b/c".to_owned()];
    let states = JointStates {
        topic: "/arm/joint_states",
        joints: &joints,
        time: &time,
        q: &q,
        dq: &dq,
        tau: &dq,
    };
    let bytes = states.to_mcap().expect("a bag");
    assert_eq!(
        bytes,
        states.to_mcap().expect("a bag"),
        "same run, same bytes"
    );
    let log = read(&bytes, &columns(&["a", "b/c"])).expect("a sound log");
    let apart = log.time.iter().zip(&time).map(|(x, y)| (x - y).abs());
    assert!(apart.fold(0.0, f64::max) < 1e-12, "time on a grid");
    assert!(log.q == q && log.dq == dq, "the numbers that were written");
    assert!(log.tau == dq, "the numbers that were written");
    let without = JointStates { dq: &[], ..states };
    let bytes = without.to_mcap().expect("a bag");
    let log = read(&bytes, &columns(&["a", "b/c"])).expect("a sound log");
    assert!(log.dq.is_empty());

    let short = JointStates {
        tau: &dq[..1],
        ..states
    };
    assert_eq!(short.to_mcap(), Err(NotABag::Lengths));
    let late = vec![3e9; time.len()];
    let late = JointStates {
        time: &late,
        ..states
    };
    assert_eq!(late.to_mcap(), Err(NotABag::Time(3e9)));
}

#[test]
fn topics_are_asked_for_where_there_are_several() {
    let left = |k| Some(message(k, &["elbow"]).write());
    let right = |k| Some(message(k + 7, &["elbow"]).write());
    let silent = |_| None;
    let bytes = bag(
        WriteOptions::new(),
        &[
            ("/right/joint_states", STATES, &right),
            ("/left/joint_states", STATES, &left),
            ("/spare/joint_states", STATES, &silent),
        ],
    );
    let elbow = columns(&["elbow"]);
    assert_eq!(
        said(&bytes, &elbow),
        "run.mcap: joint states are on several topics, `/left/joint_states`, `/right/joint_states`; name one in the spec's `log`: \
         `topic = \"/left/joint_states\";`"
    );
    for (topic, first) in [("/left/joint_states", 0.0), ("/right/joint_states", 7.0)] {
        let columns = Columns {
            topic: Some(topic.to_owned()),
            ..elbow.clone()
        };
        assert_eq!(read(&bytes, &columns).expect("a sound log").q[0][0], first);
    }
    let other = Columns {
        topic: Some("/joint_states".to_owned()),
        ..elbow.clone()
    };
    assert_eq!(
        said(&bytes, &other),
        "run.mcap: topic `/joint_states` has no joint states; they are on `/left/joint_states`, `/right/joint_states`"
    );
    let camera = |_| Some(vec![0; 10]);
    let bytes = bag(
        WriteOptions::new(),
        &[("/camera", "sensor_msgs/msg/Image", &camera)],
    );
    assert_eq!(
        said(&bytes, &elbow),
        "run.mcap: no topic has messages of type `sensor_msgs/msg/JointState` in CDR; it has `/camera`"
    );
    let bytes = bag(WriteOptions::new(), &[]);
    assert!(said(&bytes, &elbow).ends_with("it has no messages at all"));
}

#[test]
fn joints_that_are_not_there_are_told() {
    let bytes = arm(WriteOptions::new());
    assert_eq!(
        said(&bytes, &columns(&["shoulder", "wrist"])),
        "run.mcap: no message on `/joint_states` has the joint `wrist`; joints there are `elbow`, `shoulder`, `finger`; rename the spec's \
         joints accordingly, or name the bag's joints in the spec's `log`: `q = \"NAME.position\", ..; tau = \"NAME.effort\", ..;`"
    );
    assert_eq!(
        said(&bytes, &Columns::standard(2)),
        "run.mcap: it has joints by name, but no names are given; name them in `Columns::joints`"
    );
    // A log block that has its own names for CSV files does not stand in the way; one that names the bag's is followed.
    let column = |name: &str, unit: f64| Column {
        name: name.to_owned(),
        unit: Some(unit),
    };
    let of_csv = Columns {
        q: vec![column("pos 1", 0.5)],
        tau: vec![column("cur 1", 0.5)],
        ..columns(&["elbow"])
    };
    let log = read(&bytes, &of_csv).expect("a sound log");
    assert_eq!((log.q[0][8], log.tau[0][8]), (8.0, -8.0));
    let of_bag = Columns {
        q: vec![column("finger.position", 2.0)],
        tau: vec![column("finger.effort", 0.5)],
        ..columns(&["j1"])
    };
    let log = read(&bytes, &of_bag).expect("a sound log");
    assert_eq!((log.q[0][8], log.tau[0][8]), (17.0, -4.25));
}

#[test]
fn messages_of_other_joints_are_passed_over_and_lists_that_lack_numbers_are_told() {
    // Two publishers on one topic, as of an arm and of its gripper.
    let both = |k: u32| {
        let names: &[&str] = if k.is_multiple_of(2) {
            &["finger"]
        } else {
            &["elbow"]
        };
        Some(message(k, names).write())
    };
    let bytes = bag(WriteOptions::new(), &[("/joint_states", STATES, &both)]);
    let log = read(&bytes, &columns(&["elbow"])).expect("a sound log");
    assert_eq!((log.time.len(), log.q[0][1]), (500, 3.0));
    assert_eq!(
        said(&bytes, &columns(&["elbow", "finger"]))
            .split(';')
            .next(),
        Some("run.mcap: no message on `/joint_states` has all of `elbow`, `finger` at once")
    );

    let with = |change: &dyn Fn(u32, &mut JointState)| {
        let states = |k| {
            let mut message = message(k, &["elbow"]);
            change(k, &mut message);
            Some(message.write())
        };
        bag(WriteOptions::new(), &[("/joint_states", STATES, &states)])
    };
    let elbow = columns(&["elbow"]);
    let no_effort = with(&|_, message| message.efforts.clear());
    assert_eq!(
        said(&no_effort, &elbow),
        "run.mcap:1: missing column `elbow.effort`; the header has `time`, `elbow.position`, `elbow.velocity`"
    );
    let no_velocity = with(&|_, message| message.velocities = vec![f64::NAN]);
    assert!(
        read(&no_velocity, &elbow)
            .expect("a sound log")
            .dq
            .is_empty()
    );
    let never = with(&|_, message| message.efforts = vec![f64::NAN]);
    assert_eq!(
        said(&never, &elbow),
        "run.mcap:1: `NaN` in column `elbow.effort` is not finite; remove or repair the row; 1000 of 1000 rows have such a field, too many \
         to interpolate"
    );
    let once = with(&|k, message| {
        if k == 30 {
            message.efforts.clear();
        }
    });
    let log = read(&once, &elbow).expect("one of a thousand");
    assert_eq!((log.time.len(), log.tau[0][30]), (1000, -30.0));
    assert!(
        log.report[0]
            .to_string()
            .contains("run.mcap:31: `a list of 0, of 1 joints`"),
        "{:?}",
        log.report
    );
    let back = with(&|k, message| {
        if k == 500 {
            message.seconds -= 100;
        }
    });
    assert!(
        said(&back, &elbow).starts_with("run.mcap:501: time does not increase"),
        "{}",
        said(&back, &elbow)
    );
    let broken = |k| {
        let mut bytes = message(k, &["elbow"]).write();
        if k == 40 {
            bytes.truncate(30);
        }
        Some(bytes)
    };
    let bytes = bag(WriteOptions::new(), &[("/joint_states", STATES, &broken)]);
    assert_eq!(
        said(&bytes, &elbow),
        "run.mcap:41: cannot read the log: message 41 on `/joint_states`: the message ends inside the names of joints"
    );
}

/// Files that break off are refused at whatever place, and told so; damaged ones are refused or read, and nothing panics.
#[test]
fn damaged_bags_are_refused() {
    let elbow = columns(&["elbow", "shoulder"]);
    for compression in [Some(Compression::Zstd), Some(Compression::Lz4), None] {
        let sound = arm(WriteOptions::new().compression(compression));
        let step = (sound.len() / 300).max(1);
        for cut in (8..sound.len()).step_by(step) {
            let said = said(&sound[..cut], &elbow);
            assert!(said.starts_with("run.mcap:"), "{cut}: {said}");
        }
        assert!(said(&sound[..sound.len() / 2], &elbow).contains("the file is truncated"));
        let mut refused = 0;
        let mut tried = 0;
        for place in (8..sound.len()).step_by(step) {
            for mask in [0x01, 0x80, 0xff] {
                let mut bytes = sound.clone();
                bytes[place] ^= mask;
                tried += 1;
                match read(&bytes, &elbow) {
                    Err(error) => {
                        assert!(
                            error.to_string().starts_with("run.mcap:"),
                            "{place}: {error}"
                        );
                        refused += 1;
                    }
                    // Chunks have sums of their own, so what is read is what was written.
                    Ok(log) => assert_eq!(log.q[0][500], 500.0, "{place}"),
                }
            }
        }
        assert!(2 * refused > tried, "{refused} of {tried}");
    }
}

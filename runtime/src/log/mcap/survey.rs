//! Which topics of a bag have joint states.

use std::io::{Read, Seek};

use mcap::sans_io::summary_reader::{SummaryReadEvent, SummaryReader, SummaryReaderOptions};
use mcap::{McapError, Summary};

use super::super::LogError;
use super::{LONGEST, Source, damaged, guarded, is_joint_states, reader};

/// The topic that is asked for, or the only one.
pub(super) fn topic(
    source: &str,
    bag: &mut Box<dyn Source>,
    wanted: Option<&str>,
) -> Result<String, LogError> {
    let topics = topics(source, bag)?;
    let source_name = source.to_owned();
    let found = topics.joint_states;
    match (wanted, found.as_slice()) {
        (_, []) => Err(LogError::NoJointStates {
            source_name,
            present: topics.others,
        }),
        (None, [only]) => Ok(only.clone()),
        (None, _) => Err(LogError::SeveralTopics {
            source_name,
            present: found,
        }),
        (Some(wanted), _) if found.iter().any(|topic| topic == wanted) => Ok(wanted.to_owned()),
        (Some(wanted), _) => Err(LogError::NoSuchTopic {
            source_name,
            topic: wanted.to_owned(),
            present: found,
        }),
    }
}

/// Topics by name, in order, each once; those without messages are left out.
#[derive(Default)]
struct Topics {
    joint_states: Vec<String>,
    others: Vec<String>,
}

impl Topics {
    fn add(&mut self, topic: &str, is_joint_states: bool) {
        let list = if is_joint_states {
            &mut self.joint_states
        } else {
            &mut self.others
        };
        if let Err(place) = list.binary_search_by(|known| known.as_str().cmp(topic)) {
            list.insert(place, topic.to_owned());
        }
    }
}

/// From the summary at the file's end, or else from all that is before.
fn topics(source: &str, bag: &mut Box<dyn Source>) -> Result<Topics, LogError> {
    let mut topics = Topics::default();
    if let Ok(Some(summary)) = guarded(|| summary(bag)) {
        let count = |id: u16| {
            let of_channels = summary
                .stats
                .as_ref()
                .map(|stats| &stats.channel_message_counts);
            of_channels.is_none_or(|counts| counts.get(&id).is_some_and(|count| *count > 0))
        };
        for channel in summary
            .channels
            .values()
            .filter(|channel| count(channel.id))
        {
            topics.add(&channel.topic, is_joint_states(channel));
        }
        if !topics.joint_states.is_empty() {
            return Ok(topics);
        }
    }
    let back = bag.rewind();
    back.map_err(|error| damaged(source, 1, &McapError::from(error)))?;
    let mut messages = reader(bag);
    loop {
        let next = guarded(|| messages.next().transpose());
        let Some(message) = next.map_err(|error| damaged(source, 1, &error))? else {
            return Ok(topics);
        };
        topics.add(&message.channel.topic, is_joint_states(&message.channel));
    }
}

fn summary(bag: &mut Box<dyn Source>) -> Result<Option<Summary>, McapError> {
    let size = bag.seek(std::io::SeekFrom::End(0))?;
    bag.rewind()?;
    let options = SummaryReaderOptions::default()
        .with_file_size(size)
        .with_record_length_limit(LONGEST);
    let mut reader = SummaryReader::new_with_options(options);
    while let Some(event) = reader.next_event() {
        match event? {
            SummaryReadEvent::ReadRequest(count) => {
                let read = bag.read(reader.insert(count))?;
                reader.notify_read(read);
            }
            SummaryReadEvent::SeekRequest(to) => reader.notify_seeked(bag.seek(to)?),
        }
    }
    Ok(reader.finish())
}

//! Logs that are damaged, have another compression, or are not of a run.

use std::fs;

use afp_core::Instant;
use afp_core::trace::{ComponentId, Record, Sink, Verdict};
use afp_log::{LogError, doctor, read, read_any, recover};

use crate::{at, create, written};

fn chunks(bytes: &[u8]) -> Vec<(usize, usize)> {
    let summary = mcap::Summary::read(bytes).unwrap().unwrap();
    let chunks = summary.chunk_indexes.iter();
    let mut chunks: Vec<_> =
        chunks.map(|it| (it.chunk_start_offset as usize, it.chunk_length as usize)).collect();
    chunks.sort();
    chunks
}

#[test]
fn data_after_a_damaged_chunk_is_saved() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("a.mcap");
    let mut log = create(&path);
    for n in 1..=14_000 {
        log.record(at(n), &Record::Polled { supervisor: ComponentId(2), verdict: Verdict::Clear });
    }
    log.finish().unwrap();
    let (bytes, whole) = (fs::read(&path).unwrap(), recover(&path, &dir.path().join("c.mcap")));
    let (whole, chunks) = (whole.unwrap(), chunks(&bytes));
    assert!(whole.damage.is_none() && whole.missing.is_empty() && chunks.len() > 2, "{whole:?}");
    let (bad, saved) = (dir.path().join("bad.mcap"), dir.path().join("saved.mcap"));
    for (number, (begin, length)) in chunks.iter().copied().enumerate() {
        // Its kind, its length, its start time, and its contents.
        for at in [begin, begin + 1, begin + 3, begin + 8, begin + length / 2] {
            let mut bytes = bytes.clone();
            bytes[at] ^= 0x10;
            fs::write(&bad, &bytes).unwrap();
            let saved = recover(&bad, &saved).unwrap();
            assert!(saved.damage.is_some(), "byte {at}");
            let lost = whole.messages - saved.messages;
            assert!(0 < lost && lost < whole.messages * 2 / 3, "byte {at}: {lost} are lost");
            let [missing] = saved.missing[..] else { panic!("byte {at}: {:?}", saved.missing) };
            assert_eq!(missing.after.is_none(), number == 0, "byte {at}");
            assert_eq!(missing.before.is_none(), number + 1 == chunks.len(), "byte {at}");
            assert!(missing.before.is_none_or(|before| missing.after < Some(before)));
            assert_eq!(doctor(&saved.path).unwrap(), [""; 0], "byte {at}");
            let log = read(&saved.path).unwrap();
            assert_eq!(log.missing, [missing], "byte {at}");
            assert_eq!(log.recipe().until, Some(missing.after.unwrap_or(Instant::ZERO)));
        }
    }
}

#[test]
fn a_recovered_log_repeats_its_run_up_to_the_first_gap() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("a.mcap");
    let mut log = create(&path);
    for n in 1..=14_000 {
        log.record(at(n), &Record::Polled { supervisor: ComponentId(2), verdict: Verdict::Clear });
    }
    log.record(at(14_000), &Record::StopRequested);
    log.end(at(14_000), vec![("trace".to_owned(), "12ab".to_owned())]);
    log.finish().unwrap();
    let whole = read(&path).unwrap();
    assert_eq!((whole.recipe().until, whole.trace()), (Some(at(14_000)), Some("12ab")));
    let (bytes, chunks) = (fs::read(&path).unwrap(), chunks(&fs::read(&path).unwrap()));
    let [bad, saved, again] = ["bad.mcap", "b.mcap", "c.mcap"].map(|name| dir.path().join(name));
    let (begin, length) = chunks[1];
    let mut damaged = bytes.clone();
    damaged[begin + length / 2] ^= 0x10;
    for (bytes, until_the_end) in [(&damaged[..], false), (&bytes[..begin + length / 2], true)] {
        fs::write(&bad, bytes).unwrap();
        let last = read(&bad).unwrap().span.unwrap().1;
        recover(&bad, &saved).unwrap();
        // A second recovery keeps the gap.
        recover(&saved, &again).unwrap();
        let log = read(&again).unwrap();
        assert_eq!((log.recipe().until, log.trace()), (Some(last), None));
        let said = log.cut_short.unwrap();
        assert!(said.starts_with("it was recovered, and lacks the messages from "), "{said}");
        assert_eq!(said.ends_with(" to the end"), until_the_end, "{said}");
    }
}

#[test]
fn damage_outside_of_messages_loses_no_messages() {
    let dir = tempfile::tempdir().unwrap();
    let path = written(dir.path());
    let bytes = fs::read(&path).unwrap();
    let (first, _) = chunks(&bytes)[0];
    let (bad, saved) = (dir.path().join("bad.mcap"), dir.path().join("saved.mcap"));
    let whole = recover(&path, &saved).unwrap().messages;
    for at in (20..first).chain(bytes.len() - 400..bytes.len()).step_by(13) {
        let mut bytes = bytes.clone();
        bytes[at] ^= 0x10;
        fs::write(&bad, &bytes).unwrap();
        let saved = recover(&bad, &saved).unwrap();
        assert!(saved.damage.is_some(), "byte {at}");
        assert_eq!((saved.messages, &saved.missing[..]), (whole, &[][..]), "byte {at}");
    }
}

#[test]
fn an_unknown_compression_is_refused() {
    let dir = tempfile::tempdir().unwrap();
    let mut bytes = fs::read(written(dir.path())).unwrap();
    let name = b"\x03\0\0\0lz4";
    while let Some(at) = bytes.windows(name.len()).position(|it| it == name) {
        bytes[at..at + name.len()].copy_from_slice(b"\x03\0\0\0zst");
    }
    let [other, saved] = ["other.mcap", "saved.mcap"].map(|name| dir.path().join(name));
    fs::write(&other, &bytes).unwrap();
    let refused = [read(&other).err(), doctor(&other).err(), recover(&other, &saved).err()];
    for why in refused {
        let why = why.unwrap();
        assert!(matches!(&why, LogError::Compressed(how) if how == "zst"), "{why}");
        assert!(why.help().starts_with("'mcap decompress FILE"), "{}", why.help());
    }
    assert!(!saved.exists());
}

#[test]
fn a_file_without_a_run_is_reported() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("foreign.mcap");
    let mut writer = mcap::Writer::new(fs::File::create(&path).unwrap()).unwrap();
    let channel = writer.add_channel(0, "/foo", "json", &Default::default()).unwrap();
    let (sequence, log_time, publish_time) = (1, 5, 5);
    let header =
        mcap::records::MessageHeader { channel_id: channel, sequence, log_time, publish_time };
    writer.write_to_known_channel(&header, b"{}").unwrap();
    writer.finish().unwrap();
    drop(writer);
    let why = read(&path).err().unwrap().to_string();
    assert!(why.ends_with("foreign.mcap' is not the log of an AFP run"), "{why}");
    assert_eq!(read_any(&path).unwrap().topics["/foo"].messages, 1);
    assert!(doctor(&path).unwrap()[0].contains("'afp.run'"));
    assert_eq!(recover(&path, &dir.path().join("saved.mcap")).unwrap().messages, 1);
}

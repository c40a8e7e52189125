"""Reads a log of a run of wall following with only the public MCAP reader.

    python read_log.py LOG

Every CRC in the file is checked, every message decoded by its embedded schema. No code of the
project takes part, so a log that passes can be read by anybody.
"""

import io
import sys
from collections import Counter

from mcap.reader import make_reader
from mcap.stream_reader import StreamReader
from mcap_protobuf.decoder import DecoderFactory

CHANNELS = {
    "/tf": "foxglove.FrameTransforms",
    "/robot/pose": "foxglove.PoseInFrame",
    "/robot/ultrasonic": "foxglove.LaserScan",
    "/scene": "foxglove.SceneUpdate",
    "/log": "foxglove.Log",
    "/plan/events": "afp.PlanEvent",
    "/plan/configuration": "afp.Configuration",
    "/plan/table": "afp.PlanTable",
}


def main(path):
    check_crcs(path)
    check_damage(path)
    with open(path, "rb") as file:
        reader = make_reader(file, validate_crcs=True, decoder_factories=[DecoderFactory()])
        summary = reader.get_summary()
        check_channels(summary)
        check_messages(reader, summary)
        check_about(reader)


def check_crcs(path):
    """Reads the file from front to back, the CRC of every chunk checked."""
    with open(path, "rb") as file:
        records = Counter(type(r).__name__ for r in StreamReader(file, validate_crcs=True).records)
    assert records["Header"] == 1 and records["Footer"] == 1, records
    print(f"{sum(records.values())} records with their CRCs")


def check_damage(path):
    """A file with one wrong byte must not read: or the CRCs would prove nothing."""
    data = bytearray(open(path, "rb").read())
    data[len(data) // 2] ^= 1
    try:
        for _ in StreamReader(io.BytesIO(data), validate_crcs=True).records:
            pass
    except Exception as damage:
        print(f"damage is noticed: {type(damage).__name__}")
    else:
        raise AssertionError("a damaged log reads")


def check_channels(summary):
    found = {c.topic: summary.schemas[c.schema_id].name for c in summary.channels.values()}
    for topic, schema in CHANNELS.items():
        assert found.get(topic, schema) == schema, f"{topic} has {found[topic]}"
    for topic in ("/tf", "/robot/pose", "/robot/ultrasonic", "/scene", "/plan/events"):
        assert topic in found, f"{topic} is missing among {sorted(found)}"
    encodings = {c.message_encoding for c in summary.channels.values()}
    assert encodings == {"protobuf"}, encodings


def check_messages(reader, summary):
    counts, times, started, commits = Counter(), {}, [], []
    for _, channel, message, decoded in reader.iter_decoded_messages():
        counts[channel.topic] += 1
        before = times.get(channel.topic, 0)
        assert message.log_time >= before, f"time goes back on {channel.topic}"
        times[channel.topic] = message.log_time
        if channel.topic == "/plan/events":
            kind = decoded.DESCRIPTOR.enum_types_by_name["Kind"].values_by_number[decoded.kind].name
            if kind == "STARTED":
                started.append(decoded.component)
            if kind == "COMMITTED":
                commits.append(decoded.entry)
            assert kind != "LOST", "records were lost"
    assert sum(counts.values()) == summary.statistics.message_count, counts
    for topic, count in sorted(counts.items()):
        print(f"{topic:<22} {count:>6} messages")
    assert "searchFirstWall" in started and "backupCollision" in started, started
    assert "wallangle" in commits, commits
    assert max(times.values()) >= 19_000_000_000, times


def check_about(reader):
    attachments = {a.name: a.data.decode() for a in reader.iter_attachments()}
    assert any("plan WallFollowing" in text for text in attachments.values()), attachments.keys()
    assert any("version = 1" in text for text in attachments.values()), attachments.keys()
    facts = [dict(m.metadata) for m in reader.iter_metadata() if m.name == "afp.run"]
    assert len(facts) == 1, facts
    assert {"plan", "plan_hash", "seed", "world"} <= facts[0].keys(), facts
    print(f"plan {facts[0]['plan']}, seed {facts[0]['seed']}, world {facts[0]['world']}")


if __name__ == "__main__":
    main(sys.argv[1])
    print("the log reads")

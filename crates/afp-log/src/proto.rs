//! The messages of a log, made by prost-build from the files in `proto/`.
//!
//! They are kept in the repository so that building a plan needs no protobuf compiler; the test
//! `generated` compares them with the `.proto` files.

/// AFP's own messages: events and configurations of plans.
#[allow(missing_docs, clippy::enum_variant_names)]
pub mod afp {
    include!("proto/afp.rs");
}

/// The public Foxglove messages in use.
#[allow(missing_docs, clippy::enum_variant_names)]
pub mod foxglove {
    include!("proto/foxglove.rs");
}

/// `afp.proto` with what it imports, as a serialised `FileDescriptorSet`.
pub(crate) const AFP_SET: &[u8] = include_bytes!("proto/afp.fds");
/// `foxglove.proto` with what it imports, as a serialised `FileDescriptorSet`.
pub(crate) const FOXGLOVE_SET: &[u8] = include_bytes!("proto/foxglove.fds");

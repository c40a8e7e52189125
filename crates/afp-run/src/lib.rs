//! What `afpc run` and every generated binary share: options, timeline, summary, pictures.

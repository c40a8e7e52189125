//! The scenarios of the plans that are shipped.

afp::scenarios!("../../plans/tests");

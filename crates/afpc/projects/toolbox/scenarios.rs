//! The scenarios of the plans, each a test of its own.

afp::scenarios!("plans/tests", {{snake}}::templates::register);

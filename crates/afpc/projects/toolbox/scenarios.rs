//! The scenarios of the plans; each one is a test.

afp::scenarios!("plans/tests", {{snake}}::templates::register);

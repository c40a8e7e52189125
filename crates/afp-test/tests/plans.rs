//! The scenarios of the shipped plans, and of the templates that these do not use.

afp::scenarios!("../../plans/tests");

// The camera's templates, in patterned halls.
afp::scenarios!("tests/motion/scenarios.afp");

//! The scenarios of the plans that are shipped, and of templates that these do not use.

afp::scenarios!("../../plans/tests");

// Those of the camera's templates, with patterned halls of their own.
afp::scenarios!("tests/motion/scenarios.afp");

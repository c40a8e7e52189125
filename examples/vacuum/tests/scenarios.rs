//! The scenarios of the plans, each as a test.

afp::scenarios!("plans/tests", robot = vacuum::Vacuum);

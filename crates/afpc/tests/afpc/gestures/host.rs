//! A program with the plan compiled in.

use afp_run::Program;

afp::plan!("../plans/dance.afp");

fn main() -> std::process::ExitCode {
    let texts = &[("dance.afp", include_str!("../../plans/dance.afp"))];
    afp_run::main::<afp_sim::Simulation, _>(
        Program {
            name: "Dance",
            file: "plans/dance.afp",
            texts,
            toolboxes: &[],
            project: "",
            hardware: &[],
        },
        Dance::new,
    )
}

//! The run time of Action Flow Plans: time, values, configuration, component traits, scheduler, trace.

#pragma once

#include <plumbline/reports/results.h>

/// One record of each format with a different value in every field, so that a field that is lost or
/// mixed up shows.
namespace plumbline::tests {

verify::CheckResult sample_check();
reports::RunEnvironment sample_environment();
reports::RenderRecord sample_render();
reports::SpeedPoint sample_speed_point();
reports::RayCost sample_ray_cost();
reports::Bar sample_bar();
reports::StabilityRecord sample_stability_record();
reports::DuetRecord sample_duet_record();
reports::CausesRecord sample_causes_record();
reports::Figure sample_figure();
reports::Table sample_table();
reports::Distribution sample_distribution();
reports::Counter sample_counter();
reports::SeedRun sample_seed_run();
reports::HistoryRecord sample_history();

}  // namespace plumbline::tests

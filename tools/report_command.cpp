#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <plumbline/analytic/known_scene.h>
#include <plumbline/output/output_file.h>
#include <plumbline/renderer/core/errors.h>
#include <plumbline/renderer/image_io/exr.h>
#include <plumbline/reports/budgets.h>
#include <plumbline/reports/page.h>
#include <plumbline/verify/detail/budget.h>

#include "command.h"

namespace plumbline::tools {
namespace {

/// "mis, power": how the picture was made, without what the group's name says already.
std::string picture_name(const reports::RenderRecord& record) {
  std::string name = record.strategy;
  if (!record.heuristic.empty()) name += ", " + record.heuristic;
  for (const auto& [key, value] : record.parameters) name += ", " + key + "=" + value;
  return name;
}

reports::PageImage picture(const reports::RenderRecord& record) {
  const renderer::Image image = renderer::read_exr(record.image);
  reports::PageImage result{record.scene, picture_name(record), image.width, image.height, {}};
  result.rgb.reserve(image.pixels.size() * 3);
  for (const renderer::Rgbf& pixel : image.pixels) {
    result.rgb.insert(result.rgb.end(), {pixel.r, pixel.g, pixel.b});
  }
  return result;
}

/// The pictures of the records. What cannot be read, claims more than it can hold or is more than a
/// page may show becomes a warning.
std::vector<reports::PageImage> pictures(reports::Results& results) {
  std::vector<reports::PageImage> images;
  std::uint64_t pixels = 0;
  for (const reports::RenderRecord& record : results.renders) {
    if (record.image.empty()) continue;
    try {
      images.push_back(picture(record));
      pixels += images.back().rgb.size() / 3;
      if (pixels > reports::kMaxPagePixels) {
        images.pop_back();
        throw renderer::BudgetError(fmt::format(
            "left out: with it the page has more than {} pixels in its pictures: render "
            "smaller ones, or remove some records",
            reports::kMaxPagePixels));
      }
    } catch (const std::exception& error) {
      results.warnings.push_back({record.image, 0, error.what()});
    }
  }
  return images;
}

std::map<std::string, std::string> known_answers() {
  std::map<std::string, std::string> answers;
  for (const analytic::KnownScene& scene : analytic::known_scenes()) {
    answers.emplace(scene.name, scene.answer);
  }
  return answers;
}

/// The checks of one suite: those whose subjects begin alike.
struct SuiteRow {
  std::string suite;
  std::size_t checks = 0, unexpected = 0;
  double seconds = 0;
};

std::vector<SuiteRow> suite_rows(const std::vector<verify::CheckResult>& checks) {
  std::vector<SuiteRow> rows;
  for (const verify::CheckResult& check : checks) {
    const std::string suite = check.subject.substr(0, check.subject.find('/'));
    auto row =
        std::find_if(rows.begin(), rows.end(), [&](const SuiteRow& r) { return r.suite == suite; });
    if (row == rows.end()) row = rows.insert(rows.end(), SuiteRow{suite, 0, 0, 0});
    ++row->checks;
    row->unexpected += check.as_expected() ? 0u : 1u;
    row->seconds += check.seconds;
  }
  return rows;
}

void print_summary(const reports::Results& results, const reports::Summary& summary) {
  fmt::print("{:<32} {:>7} {:>11} {:>9}\n", "suite", "checks", "unexpected", "seconds");
  for (const SuiteRow& row : suite_rows(results.checks)) {
    fmt::print("{:<32} {:>7} {:>11} {:>9.2f}\n", row.suite, row.checks, row.unexpected,
               row.seconds);
  }
  fmt::print(
      "\n{} checks: {} passed, {} caught as they should be, {} inconclusive as expected, {}{} "
      "unexpected\n",
      summary.checks(), summary.passed, summary.failed_as_expected,
      summary.inconclusive_as_expected,
      summary.waived > 0 ? fmt::format("{} waived, ", summary.waived) : std::string(),
      summary.unexpected);
  for (const verify::CheckResult& check : results.checks) {
    if (!check.as_expected()) fmt::print("\n{}\n", verify::describe(check));
  }
  for (const reports::ReadWarning& warning : results.warnings) {
    output::tell(fmt::format("warning: {}{}: {}\n", warning.file.string(),
                             warning.line == 0 ? std::string() : fmt::format(":{}", warning.line),
                             warning.what));
  }
}

/// Makes the page of a results directory and prints a summary table.
///
/// Pictures are the EXR files that the render records in the directory name; one that cannot be
/// read is a warning on the page, like every record that cannot.
///
/// @param results_dir  searched for records, subdirectories included (reports::read_results)
/// @param output       the HTML file; replaced only by a whole new page
/// @param max_checks   bound on the number of checks that the error budget is split over
/// @return             0; 1 where a check did not give its expected verdict, a record was lost, or
///                     there are more checks than max_checks, so that their levels add up to more
///                     than the budget
/// @throws InputError for a directory that holds no results, and an output that cannot be written
///         or is one of the records or pictures; MachineError where the disk is full
int run_report(const std::filesystem::path& results_dir, const std::filesystem::path& output,
               std::uint64_t max_checks) {
  try {
    output::Files files;
    output::OutputFile& page = files.writes("--output", output);
    reports::PageInput input;
    input.results = reports::read_results(results_dir);
    for (const std::filesystem::path& file : input.results.files) files.reads(file);
    for (const reports::RenderRecord& record : input.results.renders) files.reads(record.image);
    input.images = pictures(input.results);
    input.answers = known_answers();
    page.fill([&](const auto& path) { write_page(input, path); });
    files.finish();
    const reports::Summary summary = reports::summarise(input.results);
    print_summary(input.results, summary);
    fmt::print("page: {}\n", output.string());
    if (summary.checks() > max_checks) {
      output::tell(
          fmt::format("plumbline: {} checks, but the error budget is split over {}: the chance of "
                      "a false alarm is not what it claims to be\n",
                      summary.checks(), max_checks));
      return kExitUnexpectedVerdict;
    }
    return summary.unexpected == 0 && summary.unreadable == 0 ? kExitFine : kExitUnexpectedVerdict;
  } catch (const reports::ResultsError& error) {
    throw renderer::InputError(error.what());
  }
}

}  // namespace

void add_report_command(options::CommandLine& line) {
  struct Arguments {
    std::string results, page;
    std::uint64_t max_checks = verify::ErrorBudget{}.max_checks;
  };
  const auto arguments = std::make_shared<Arguments>();
  options::Command command = line.add_command("report", "Make the page of a results directory");
  command.add("results", arguments->results, "Directory with records").required().type("");
  command.add("-o,--output", arguments->page, "HTML file to write").required().type("FILE");
  command
      .add("--max-checks", arguments->max_checks,
           "Refuse a run of more checks: the error budget is split over so many")
      .shows_default()
      .type("N");
  command.footer("Example:\n  plumbline report build/release/results -o index.html");
  command.runs([arguments] {
    return run_report(arguments->results, arguments->page, arguments->max_checks);
  });
}

}  // namespace plumbline::tools

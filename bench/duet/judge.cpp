#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include <plumbline/options/options.h>
#include <plumbline/reports/duet_record.h>
#include <plumbline/reports/results.h>
#include <plumbline/verify/history/duet.h>

// plumbline_duet_judge: reads records of duets, a JSON document a line, and answers each with a
// line "ratio low high narrow verdict", where `narrow` is 1 if more pairs would not help.
namespace {

using plumbline::reports::DuetRecord;

/// Half the interval's width at which a part is done: a change of 2 % is then found, with the
/// margin of 1 % between it and none.
constexpr double kHalfWidth = 0.005;

void judge(DuetRecord& record) {
  if (record.a_seconds.empty()) return;
  std::vector<plumbline::verify::history::DuetPair> pairs;
  for (std::size_t i = 0; i < record.a_seconds.size(); ++i) {
    pairs.push_back({record.a_seconds[i], record.b_seconds[i]});
  }
  const auto duet = plumbline::verify::history::duet_ratio(pairs, record.confidence);
  record.ratio = duet.ratio;
  record.low = duet.low;
  record.high = duet.high;
}

std::vector<DuetRecord> read_and_judge(std::istream& in) {
  std::vector<DuetRecord> records;
  for (std::string line; std::getline(in, line);) {
    records.push_back(plumbline::reports::parse_duet_record(line));
    judge(records.back());
  }
  return records;
}

void print(const DuetRecord& record) {
  const bool narrow = std::log(record.high / record.low) <= 2 * kHalfWidth;
  std::printf("%.6f %.6f %.6f %d %s\n", record.ratio, record.low, record.high, narrow ? 1 : 0,
              std::string(verdict(record)).c_str());
}

/// A log of its own, without what an earlier run left there.
void keep(const std::vector<DuetRecord>& records, const std::filesystem::path& file) {
  std::filesystem::remove(file);
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  plumbline::reports::ResultLog log(folder, file.stem().string());
  for (const DuetRecord& record : records) log.append(record);
}

}  // namespace

int main(int argc, char** argv) try {
  plumbline::options::CommandLine line("Judges duets, read as records from the standard input");
  std::string file;
  line.program().add("--json", file, "Keep the records in this file, *.jsonl");
  if (const auto printed = line.parse(argc, argv)) return *printed ? 0 : 2;
  const std::vector<DuetRecord> records = read_and_judge(std::cin);
  for (const DuetRecord& record : records) print(record);
  if (!file.empty()) keep(records, file);
  return 0;
} catch (const std::exception& error) {
  std::cerr << "plumbline_duet_judge: " << error.what() << "\n";
  return 2;
}

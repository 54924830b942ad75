#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <plumbline/reports/history.h>
#include <plumbline/reports/history_record.h>

/// What `plumbline history` prints.
namespace plumbline::tools {

/// One run on each line, the latest last.
std::string history_list(const reports::History& history);

/// Everything about one run, for a person at a terminal.
std::string history_show(const reports::History& history, std::int64_t id);

/// What became of one run, in Markdown for the page of a job: parts, checks that did not give their
/// expected verdict, runs of the gate with fresh seeds.
std::string history_summary(const reports::History& history, std::int64_t id);

/// What all runs show together, in Markdown: changes of numbers, what the sequences of the checks
/// have refuted or proven, failures of the gate with fresh seeds.
std::string history_changes(const reports::HistoryRecord& record);

/// The tables that history_csv knows.
std::vector<std::string> history_tables();

/// A table of all runs as comma-separated values (RFC 4180), one value to a line, with the run, its
/// time, kind, commit, hash of sources and machine in front.
std::string history_csv(const reports::History& history, std::string_view table);

}  // namespace plumbline::tools

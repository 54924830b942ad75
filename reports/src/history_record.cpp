#include <plumbline/reports/history_record.h>

#include "files.h"
#include "history_fields.h"

namespace plumbline::reports {
namespace {

void require_on_axis(const HistoryRecord& record) {
  const std::size_t nights = record.nights.size();
  for (const TrackedNumber& number : record.numbers) {
    bool fits = number.median.size() == nights && number.low.size() == nights &&
                number.high.size() == nights;
    for (const HistoryChange& change : number.changes) {
      fits = fits && change.first_night <= change.last_night && change.last_night < nights;
    }
    for (const std::uint64_t night : number.odd_nights) fits = fits && night < nights;
    if (!fits) throw FormatError("number \"" + number.name + "\" does not fit the axis of nights");
  }
  for (const TrackedSequence& sequence : record.sequences) {
    const auto fits = [&](const std::vector<double>& list) {
      return list.empty() || list.size() == nights;
    };
    if (fits(sequence.bound) && fits(sequence.evidence)) continue;
    throw FormatError("sequence \"" + sequence.subject + "\" is not as long as the axis of nights");
  }
}

}  // namespace

std::string to_json(const HistoryRecord& record) {
  require_on_axis(record);
  return detail::document(detail::kHistoryFormat, record);
}

void write_history(const std::filesystem::path& path, const HistoryRecord& record) {
  detail::write_file(path, to_json(record) + "\n");
}

HistoryRecord parse_history(std::string_view json) {
  HistoryRecord record = detail::parse_document<HistoryRecord>(detail::kHistoryFormat, json);
  require_on_axis(record);
  return record;
}

}  // namespace plumbline::reports

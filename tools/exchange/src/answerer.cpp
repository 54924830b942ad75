#include <plumbline/exchange/answerer.h>

#include <algorithm>
#include <array>
#include <cstring>

#include <plumbline/exchange/npy.h>

#include "received.h"
#include "shown.h"
#include "transport.h"

namespace plumbline::exchange {
namespace {

using verify::Channels;
using verify::SampleRecord;
using verify::Uniforms;
using verify::Vec3;

constexpr const char* kSee = " (the protocol is docs/protocol.md)";

template <class T>
void put_rows(std::span<const std::array<double, 3>> rows, std::size_t columns, std::byte* to) {
  for (const std::array<double, 3>& row : rows) {
    for (std::size_t i = 0; i < columns; ++i) {
      const T value = static_cast<T>(row[i]);
      std::memcpy(to, &value, sizeof value);
      to += sizeof value;
    }
  }
}

std::unique_ptr<Transport> make_transport(const AnswererOptions& options) {
  if (options.folder.empty()) return make_pipe_transport(options);
  return make_folder_transport(options);
}

/// Points of a BSDF are directions.
const char* points_name(std::span<const Vec3> wo) { return wo.empty() ? "x" : "wi"; }

Channels channels_at(const ReceivedArray& array, std::size_t row) {
  Channels channels;
  channels.count = array.columns();
  for (std::size_t i = 0; i < channels.count; ++i) channels.value[i] = array.at(row, i);
  return channels;
}

}  // namespace

Answerer::Answerer(const AnswererOptions& options) : transport_(make_transport(options)) {
  std::string line;
  try {
    line = transport_->hello();
    hello_ = reports::parse_answerer_hello(line);
  } catch (const reports::FormatError& error) {
    throw AnswererError("the program's first line, " + shown(line) +
                        ", is not what it must be: " + error.what() + kSee);
  } catch (const TransportError& error) {
    throw AnswererError(std::string("waiting for the program's first line: ") + error.what() +
                        kSee);
  }
}

Answerer::~Answerer() = default;

void Answerer::set_dimensions(std::size_t coordinates) {
  if (coordinates < 1 || coordinates > 3) throw std::invalid_argument("1, 2 or 3 coordinates");
  coordinates_ = coordinates;
}

/// What a query is about, and where its arrays are.
struct Answerer::Query {
  const char* kind;
  std::size_t count;
  std::span<const Vec3> wo, points;  ///< u or x
  const char* points_name;
  std::size_t columns;  ///< of the points
};

void Answerer::send(const Query& query) {
  outgoing_ = std::make_unique<OutgoingQuery>();
  OutgoingQuery& outgoing = *outgoing_;
  outgoing.number = queries_;
  outgoing.line = reports::query_line(queries_, query.kind, query.count);
  const std::size_t size = hello_.float64 ? sizeof(double) : sizeof(float);
  const std::size_t wo_bytes = query.wo.size() * 3 * size;
  sent_.resize(std::max(sent_.size(), wo_bytes + query.count * query.columns * size));
  std::size_t at = 0;
  const auto add = [&](const char* name, std::span<const Vec3> rows, std::size_t columns) {
    NpyHeader header;
    header.type = hello_.float64 ? NpyType::float64 : NpyType::float32;
    header.dimensions = 2;
    header.rows = rows.size();
    header.columns = columns;
    (hello_.float64 ? put_rows<double> : put_rows<float>)(rows, columns, &sent_[at]);
    const std::size_t bytes = rows.size() * columns * size;
    outgoing.arrays.push_back({name, npy_header(header), std::span(sent_).subspan(at, bytes)});
    at += bytes;
  };
  if (!query.wo.empty()) add("wo", query.wo, 3);
  add(query.points_name, query.points, query.columns);
  transport_->send(outgoing);
}

void Answerer::read_answer_line() {
  const std::string line = transport_->answer_line();
  reports::AnswerLine answer;
  try {
    answer = reports::parse_answer_line(line);
  } catch (const reports::FormatError& error) {
    throw TransportError("its answer begins with " + shown(line) +
                         " and not with the line of the query: " + error.what());
  }
  if (answer.query != queries_) {
    throw TransportError("its answer is one to query " + std::to_string(answer.query));
  }
  if (!answer.error.empty()) throw TransportError("the program says: " + answer.error);
}

ReceivedArray Answerer::read(const ArrayWanted& wanted, std::vector<std::byte>& bytes) {
  try {
    return read_array(transport_->array(wanted.name), wanted, bytes);
  } catch (const NpyError& error) {
    throw TransportError("its array \"" + std::string(wanted.name) + "\" " + error.what());
  }
}

template <class Exchange>
void Answerer::attempt(const Query& query, const Exchange& exchange) {
  if (!broken_.empty()) throw AnswererError(broken_);
  ++queries_;
  values_ += query.count;
  try {
    send(query);
    read_answer_line();
    exchange();
    transport_->end_answer();
  } catch (const TransportError& error) {
    broken_ = "query " + std::to_string(queries_) + " (" + query.kind + ", " +
              std::to_string(query.count) + (query.count == 1 ? " value" : " values") +
              "): " + error.what() + kSee;
    transport_.reset();
    throw AnswererError(broken_);
  }
}

template <class Ask>
void Answerer::in_batches(std::span<const Vec3> wo, std::span<const Vec3> points, const Ask& ask) {
  for (std::size_t first = 0; first < points.size(); first += kMostValues) {
    const std::size_t count = std::min(kMostValues, points.size() - first);
    ask(wo.empty() ? wo : wo.subspan(first, count), points.subspan(first, count), first, count);
  }
}

void Answerer::sample(std::span<const Vec3> wo, std::span<const Uniforms> u,
                      std::span<std::optional<SampleRecord>> out) {
  in_batches(wo, u, [&](auto given, auto numbers, std::size_t first, std::size_t count) {
    const Query query{"sample", count, given,
                      numbers,  "u",   static_cast<std::size_t>(hello_.numbers)};
    attempt(query, [&] { read_samples(points_name(wo), out.subspan(first, count)); });
  });
}

void Answerer::read_samples(const char* name, std::span<std::optional<SampleRecord>> out) {
  const std::size_t n = out.size();
  const ReceivedArray x = read({name, n, coordinates_, coordinates_}, received_[0]);
  const ReceivedArray pdf = read({"pdf", n, 1, 1, true}, received_[1]);
  const ReceivedArray weight = read({"weight", n, 1, Channels::kMost, true}, received_[2]);
  const ReceivedArray accepted = read({"accepted", n, 1, 1, false, true}, received_[3]);
  const ReceivedArray mass =
      hello_.has_atoms ? read({"mass", n, 1, 1}, received_[4]) : ReceivedArray{};
  for (std::size_t i = 0; i < n; ++i) {
    if (!accepted.flag(i)) {
      out[i].reset();
      continue;
    }
    SampleRecord& record = out[i].emplace();
    for (std::size_t c = 0; c < coordinates_; ++c) record.x[c] = x.at(i, c);
    if (!mass.empty()) record.mass = mass.at(i, 0);
    if (!pdf.empty() && !(record.mass > 0)) record.pdf = pdf.at(i, 0);
    if (!weight.empty()) record.weight = channels_at(weight, i);
  }
}

void Answerer::pdf(std::span<const Vec3> wo, std::span<const Vec3> x, std::span<double> out) {
  in_batches(wo, x, [&](auto given, auto points, std::size_t first, std::size_t count) {
    attempt({"pdf", count, given, points, points_name(wo), coordinates_}, [&] {
      const ReceivedArray pdf = read({"pdf", count, 1, 1}, received_[0]);
      for (std::size_t i = 0; i < count; ++i) out[first + i] = pdf.at(i, 0);
    });
  });
}

void Answerer::eval(std::span<const Vec3> wo, std::span<const Vec3> x, std::span<Channels> out) {
  in_batches(wo, x, [&](auto given, auto points, std::size_t first, std::size_t count) {
    attempt({"eval", count, given, points, points_name(wo), coordinates_}, [&] {
      const ReceivedArray f = read({"f", count, 1, Channels::kMost}, received_[0]);
      for (std::size_t i = 0; i < count; ++i) out[first + i] = channels_at(f, i);
    });
  });
}

std::string Answerer::finish() {
  if (!transport_) return {};
  try {
    return transport_->finish();
  } catch (const TransportError& error) {
    return error.what();
  }
}

}  // namespace plumbline::exchange

#include <poll.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <string_view>
#include <system_error>

#include "child_process.h"
#include "shown.h"
#include "transport.h"

namespace plumbline::exchange {
namespace {

using namespace std::chrono_literals;

class PipeTransport : public Transport, private ByteSource {
 public:
  explicit PipeTransport(const AnswererOptions& options)
      : seconds_(options.timeout), process_(options.command) {}

  std::string hello() override {
    start();
    return line();
  }

  void send(const OutgoingQuery& query) override {
    require_silence();
    start();
    line_ = query.line + "\n";
    put(line_.data(), line_.size());
    for (const OutgoingArray& array : query.arrays) {
      put(array.header.data(), array.header.size());
      put(array.data.data(), array.data.size());
    }
    write_some();
  }

  std::string answer_line() override { return line(); }
  ByteSource& array(const std::string&) override { return *this; }

  void end_answer() override {
    while (!unsent_.empty()) {
      if (wait()) require_silence();
    }
  }

  std::string finish() override {
    require_silence();
    process_.close_input();
    start();
    while (!process_.ended(std::min(deadline_, Clock::now() + 10ms))) {
      require_silence();
      if (Clock::now() >= deadline_) {
        return "the program did not end within " + seconds_text(seconds_) +
               " of the end of its input and was killed";
      }
    }
    const std::string failure = process_.failure();
    return failure.empty() ? failure : "the program " + failure + " after its last answer";
  }

 private:
  void start() {
    deadline_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                   std::chrono::duration<double>(seconds_));
    sent_bytes_ = received_bytes_ = 0;
    unsent_.clear();
    next_unsent_ = 0;
  }

  void put(const void* data, std::size_t size) {
    if (size > 0) unsent_.push_back({const_cast<void*>(data), size});
  }

  /// As much of the query as the pipe takes.
  void write_some() {
    constexpr std::size_t kMostParts = 16;
    while (next_unsent_ < unsent_.size()) {
      const auto parts = static_cast<int>(std::min(kMostParts, unsent_.size() - next_unsent_));
      const ssize_t written = writev(process_.input(), &unsent_[next_unsent_], parts);
      if (written < 0 && errno == EINTR) continue;
      if (written < 0 && errno == EAGAIN) return;
      if (written < 0 && errno == EPIPE) gone("closed its standard input");
      if (written < 0) throw std::system_error(errno, std::generic_category(), "to the program");
      skip_sent(static_cast<std::size_t>(written));
    }
    unsent_.clear();
    next_unsent_ = 0;
  }

  void skip_sent(std::size_t written) {
    sent_bytes_ += written;
    while (written > 0) {
      iovec& part = unsent_[next_unsent_];
      const std::size_t taken = std::min(written, part.iov_len);
      part.iov_base = static_cast<char*>(part.iov_base) + taken;
      part.iov_len -= taken;
      written -= taken;
      if (part.iov_len == 0) ++next_unsent_;
    }
  }

  /// Waits until the program writes or takes more of the query, which is sent then: both at once,
  /// or it could wait for us to read while we wait for it to.
  /// @return whether there is something to read
  bool wait() {
    std::array<pollfd, 2> ends{};
    ends[0] = {process_.output(), POLLIN, 0};
    ends[1] = {process_.input(), POLLOUT, 0};
    const auto left =
        std::chrono::ceil<std::chrono::milliseconds>(deadline_ - Clock::now()).count();
    if (left <= 0) too_late();
    const int ready = poll(ends.data(), unsent_.empty() ? 1 : 2,
                           static_cast<int>(std::min<std::int64_t>(left, 1 << 30)));
    if (ready < 0 && errno != EINTR) {
      throw std::system_error(errno, std::generic_category(), "poll");
    }
    if (ready <= 0) return false;
    if (ends[1].revents != 0) write_some();
    return ends[0].revents != 0;
  }

  [[noreturn]] void too_late() const {
    std::string what = "the program did not answer within " + seconds_text(seconds_);
    std::size_t unsent = 0;
    for (std::size_t i = next_unsent_; i < unsent_.size(); ++i) unsent += unsent_[i].iov_len;
    if (unsent > 0) {
      what += ": it took no more than " + std::to_string(sent_bytes_) + " of " +
              std::to_string(sent_bytes_ + unsent) + " bytes of the query";
    } else if (received_bytes_ > 0) {
      what += ": its answer stops after " + std::to_string(received_bytes_) + " bytes";
    } else {
      what += "; does it flush what it writes? Else allow it more with --timeout";
    }
    throw TransportError(what);
  }

  /// The other end of a pipe is closed: why?
  [[noreturn]] void gone(const char* what) {
    const bool ended = process_.ended(std::min(deadline_, Clock::now() + 1s));
    if (!ended) throw TransportError(std::string("the program ") + what + ", but still runs");
    const std::string failure = process_.failure();
    throw TransportError("the program " + (failure.empty() ? "ended with exit status 0" : failure) +
                         " before its answer was complete" +
                         (failure.empty() ? "; it must answer until its input ends" : ""));
  }

  /// What there is to read, at most that much, but not nothing unless `may_be_nothing`.
  std::size_t receive(std::byte* to, std::size_t most) {
    for (;;) {
      if (!wait()) continue;
      const ssize_t n = ::read(process_.output(), to, most);
      if (n == 0) gone("closed its standard output");
      if (n > 0) {
        received_bytes_ += static_cast<std::size_t>(n);
        return static_cast<std::size_t>(n);
      }
      if (errno != EINTR && errno != EAGAIN) {
        throw std::system_error(errno, std::generic_category(), "from the program");
      }
    }
  }

  std::span<const std::byte> buffered() const {
    return std::span(buffer_).subspan(begin_, end_ - begin_);
  }

  void fill_buffer() {
    begin_ = 0;
    end_ = 0;
    end_ = receive(buffer_.data(), buffer_.size());
  }

  void read(std::byte* to, std::size_t count) override {
    while (count > 0) {
      if (begin_ == end_ && count >= buffer_.size()) {
        const std::size_t n = receive(to, count);
        to += n;
        count -= n;
        continue;
      }
      if (begin_ == end_) fill_buffer();
      const std::size_t n = std::min(count, end_ - begin_);
      std::memcpy(to, buffered().data(), n);
      begin_ += n;
      to += n;
      count -= n;
    }
  }

  std::string line() {
    std::string text;
    for (;;) {
      if (begin_ == end_) fill_buffer();
      const std::span<const std::byte> there = buffered();
      const auto end = std::find(there.begin(), there.end(), std::byte{'\n'});
      const auto size = static_cast<std::size_t>(end - there.begin());
      text.append(reinterpret_cast<const char*>(there.data()), size);
      begin_ += size;
      if (text.size() > kLongestLine) {
        throw TransportError("the program wrote no line of JSON, but " + shown(text));
      }
      if (end == there.end()) continue;
      ++begin_;
      return text;
    }
  }

  /// Between answers a program has nothing to say.
  void require_silence() {
    if (begin_ == end_) {
      const ssize_t n = ::read(process_.output(), buffer_.data(), buffer_.size());
      if (n < 0 || (n == 0 && process_.input() < 0)) return;
      if (n == 0) gone("closed its standard output");
      begin_ = 0;
      end_ = static_cast<std::size_t>(n);
    }
    const std::span<const std::byte> stray = buffered();
    throw TransportError(
        "the program wrote more than its last answer: " +
        shown({reinterpret_cast<const char*>(stray.data()), stray.size()}) +
        "; are the shapes in its headers those of the data, and its messages on standard error?");
  }

  IgnoredPipeSignal ignored_;
  double seconds_;
  ChildProcess process_;
  Clock::time_point deadline_;
  std::string line_;
  std::vector<iovec> unsent_;
  std::size_t next_unsent_ = 0;
  std::size_t sent_bytes_ = 0, received_bytes_ = 0;
  std::array<std::byte, 1 << 16> buffer_;
  std::size_t begin_ = 0, end_ = 0;  // of what is in the buffer
};

}  // namespace

std::unique_ptr<Transport> make_pipe_transport(const AnswererOptions& options) {
  return std::make_unique<PipeTransport>(options);
}

std::string seconds_text(double seconds) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g s", seconds);
  return text.data();
}

}  // namespace plumbline::exchange

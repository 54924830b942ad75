#include "render_by_ranks.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstring>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/output/stop.h>

#include "shard.h"

namespace plumbline::tools {
namespace {

using renderer::RenderState;

Shard shard_of(int rank, const mpi::Ranks& ranks) {
  return {static_cast<std::uint32_t>(rank) + 1, static_cast<std::uint32_t>(ranks.count())};
}

/// What a part that is sent is followed by.
enum class Next : char { more, done };

/// A part on its way to the first rank: what follows, the signal that stopped it or 0, the state.
std::string packed(Next next, int signal, const RenderState& part) {
  return std::string{static_cast<char>(next), static_cast<char>(signal)} +
         output::bytes_of_state(part);
}

constexpr std::size_t kHeader = 2;

std::string packed(const std::vector<renderer::SampleNeed>& needs) {
  return {reinterpret_cast<const char*>(needs.data()), needs.size() * sizeof(needs[0])};
}

std::vector<renderer::SampleNeed> needs_of(const mpi::Message& message) {
  std::vector<renderer::SampleNeed> needs(message.bytes.size() / sizeof(renderer::SampleNeed));
  std::memcpy(needs.data(), message.bytes.data(), message.bytes.size());
  return needs;
}

class RankedRender {
 public:
  RankedRender(mpi::Ranks& ranks, const renderer::Scene& scene,
               const renderer::RenderOptions& options, double every)
      : ranks_(ranks),
        scene_(scene),
        options_(options),
        every_(every),
        shard_(shard_of(ranks.rank(), ranks)) {
    deal_out();
    // Parts come halfway between the times at which the whole is kept.
    if (!ranks_.is_first()) kept_ -= seconds(every_ / 2);
  }

  renderer::RenderResult run() {
    while (const std::uint32_t target = next_target()) {
      if (options_.adaptive) share_needs();
      missing_ = ranks_.count() - 1;
      render_up_to(target);
      gather();
    }
    const auto signal = static_cast<int>(ranks_.first_says(static_cast<std::uint64_t>(signal_)));
    if (signal != 0) output::ask_to_stop(signal);
    renderer::RenderResult result{{renderer::Film(0, 0), {}, 0, 0, signal != 0, {}}, {}};
    if (ranks_.is_first()) complete(result);
    return result;
  }

 private:
  using Clock = std::chrono::steady_clock;

  static Clock::duration seconds(double seconds) {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  }

  static double seconds_since(Clock::time_point then) {
    return std::chrono::duration<double>(Clock::now() - then).count();
  }

  bool is_due() const { return every_ > 0 && seconds_since(kept_) >= every_; }

  /// The first rank has the whole, each its part of it.
  void deal_out() {
    RenderState own = fresh_state(scene_.camera().width(), scene_.camera().height(), options_);
    const auto& from = options_.interruptions.from;
    const bool goes_on = ranks_.first_says(from ? 1 : 0) != 0;
    if (ranks_.is_first()) {
      if (goes_on) own = *from;
      whole_ = own;
      seconds_before_ = whole_.seconds;
      counters_.resize(static_cast<std::size_t>(ranks_.count()));
      for (int rank = 1; goes_on && rank < ranks_.count(); ++rank) {
        ranks_.send(rank, output::bytes_of_state(taken_out(shard_of(rank, ranks_), whole_)));
      }
    } else if (goes_on) {
      put_back(shard_, output::state_of_bytes(ranks_.receive(0).bytes), own);
    }
    keep_only(shard_, own);
    own_ = std::make_shared<const RenderState>(std::move(own));
  }

  /// What pixels need, learnt of the pilots of all, is known to all before they go on.
  void share_needs() {
    if (needs_shared_) return;
    if (ranks_.is_first()) learn_needs(whole_, options_);
    needs_shared_ = ranks_.first_says(whole_.needs.empty() ? 0 : 1) != 0;
    if (!needs_shared_) return;
    if (ranks_.is_first()) {
      for (int rank = 1; rank < ranks_.count(); ++rank) ranks_.send(rank, packed(whole_.needs));
    }
    RenderState own = *own_;
    own.needs = ranks_.is_first() ? whole_.needs : needs_of(ranks_.receive(0));
    own_ = std::make_shared<const RenderState>(std::move(own));
  }

  /// Samples per pixel where the first rank looks at limits next; 0 at the end.
  std::uint32_t next_target() const {
    std::uint32_t target = 0;
    if (ranks_.is_first()) {
      const std::uint32_t done = level_of(whole_, options_);
      const bool goes_on = signal_ == 0 && done < options_.samples_per_pixel;
      if (goes_on && !is_good_enough(whole_, options_)) target = next_look(done, options_);
    }
    return static_cast<std::uint32_t>(ranks_.first_says(target));
  }

  void render_up_to(std::uint32_t target) {
    renderer::RenderOptions options = options_;
    options.samples_per_pixel = options_.allocation ? options_.samples_per_pixel : target;
    options.relative_error = 0;
    options.interruptions.stop = [] { return output::stop_signal() != 0; };
    options.interruptions.from = own_;
    options.interruptions.keep = [&](const RenderState& state, bool is_last) {
      if (is_last) {
        own_ = std::make_shared<const RenderState>(state);
      } else {
        keep(state);
      }
    };
    if (render(scene_, options).stopped) signal_ = output::stop_signal();
  }

  /// Between slices.
  void keep(const RenderState& state) {
    if (!ranks_.is_first()) {
      if (is_due() && ranks_.post(0, packed(Next::more, 0, taken_out(shard_, state)))) {
        kept_ = Clock::now();
      }
      return;
    }
    while (const auto message = ranks_.take(mpi::kAnyRank)) take(*message);
    if (!is_due()) return;
    put(0, taken_out(shard_, state));
    keep_whole();
  }

  /// The parts of all, each when it is done.
  void gather() {
    const RenderState own = taken_out(shard_, *own_);
    if (!ranks_.is_first()) {
      ranks_.send(0, packed(Next::done, signal_, own));
      return;
    }
    put(0, own);
    while (missing_ > 0) {
      take(ranks_.receive(mpi::kAnyRank));
      if (is_due()) keep_whole();
    }
  }

  void take(const mpi::Message& message) {
    put(message.from, output::state_of_bytes(message.bytes.substr(kHeader)));
    if (static_cast<Next>(message.bytes[0]) == Next::more) return;
    --missing_;
    if (message.bytes[1] != 0) signal_ = static_cast<unsigned char>(message.bytes[1]);
  }

  void put(int rank, const RenderState& part) {
    put_back(shard_of(rank, ranks_), part, whole_);
    counters_[static_cast<std::size_t>(rank)] = part.counters;
  }

  void keep_whole() {
    whole_.counters = {};
    for (const renderer::PathCounters& counters : counters_) whole_.counters += counters;
    whole_.seconds = seconds_before_ + seconds_since(start_);
    if (options_.interruptions.keep) options_.interruptions.keep(whole_, true);
    kept_ = Clock::now();
  }

  /// As `render` ends.
  void complete(renderer::RenderResult& result) {
    put(0, taken_out(shard_, *own_));
    keep_whole();
    result.counters = whole_.counters;
    result.samples_per_pixel = renderer::samples_per_pixel(whole_, options_);
    result.seconds = whole_.seconds;
    result.stopped = result.stopped && level_of(whole_, options_) < options_.samples_per_pixel;
    result.film = whole_.take_film();
    result.drawn = std::move(whole_.drawn);
    result.bsdf_counts = std::move(whole_.bsdf_counts);
  }

  mpi::Ranks& ranks_;
  const renderer::Scene& scene_;
  const renderer::RenderOptions& options_;
  double every_;
  Shard shard_;
  Clock::time_point start_ = Clock::now(), kept_ = start_;
  std::shared_ptr<const RenderState> own_;  // of the whole image, other ranks' pixels elsewhere
  RenderState whole_;                       // in the first rank: the last that came of all
  std::vector<renderer::PathCounters> counters_;  // of each rank
  double seconds_before_ = 0;
  int missing_ = 0;  // ranks that are not done with what was asked for
  int signal_ = 0;   // that stopped a rank
  bool needs_shared_ = false;
};

}  // namespace

void require_one_render(mpi::Ranks& ranks, const output::CheckpointSettings& settings) {
  const std::vector<std::string> names = gather(ranks, ranks.name());
  const std::vector<std::string> all = gather(ranks, output::bytes_of_settings(settings));
  agree(ranks, [&] {
    for (std::size_t i = 0; i < all.size(); ++i) {
      output::require_same(names[i], output::settings_of_bytes(all[i]), settings);
    }
  });
}

renderer::RenderResult render_by_ranks(mpi::Ranks& ranks, const renderer::Scene& scene,
                                       const renderer::RenderOptions& options, double every) {
  return RankedRender(ranks, scene, options, every).run();
}

}  // namespace plumbline::tools

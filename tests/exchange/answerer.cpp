#include <fcntl.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <plumbline/exchange/npy.h>

/// Answers for a Lambertian BSDF, well or as badly as its first argument says; the second is its
/// precision, the third how many queries it answers well before it does so.
namespace plumbline::exchange {
namespace {

struct Input : ByteSource {
  void read(std::byte* to, std::size_t count) override {
    if (std::fread(to, 1, count, stdin) != count) throw std::runtime_error("a query is cut short");
  }
};

void write_text(const std::string& text) { std::fwrite(text.data(), 1, text.size(), stdout); }

struct Query {
  int number = 0;
  std::string line, kind;
  std::size_t count = 0;
};

template <class T>
class Program {
 public:
  Program(std::string mode, int well) : mode_(std::move(mode)), well_(well) {}

  void run() {
    greet();
    Query query;
    while (next(query)) {
      const bool badly = query.number > well_;
      if (badly) misbehave_before(query);
      if (badly && mode_ == "early") {
        write_text(query.line);
        std::fflush(stdout);
      }
      if (mode_ == "square") {
        answer_for_square(query);
        continue;
      }
      read_arrays(query);
      if (!(badly && mode_ == "early")) write_text(query.line);
      answer(query, badly);
      std::fflush(stdout);
      if (badly && mode_ == "midway") hang();
    }
    if (mode_ == "bad-end") std::exit(5);
    if (mode_ == "no-end") hang();
  }

 private:
  static constexpr NpyType kType = sizeof(T) == 4 ? NpyType::float32 : NpyType::float64;

  [[noreturn]] static void hang() {
    for (;;) pause();
  }

  void greet() const {
    if (mode_ == "silent") hang();
    write_text(R"({"protocol": "plumbline/)" + std::string(mode_ == "version" ? "9" : "1") +
               R"(", "name": "test", "precision": ")" + (sizeof(T) == 4 ? "float32" : "float64") +
               R"(", "numbers": 2, "functions": ["sample", "pdf")" +
               (mode_ == "no-eval" ? "" : R"(, "eval")") + "]" +
               (mode_ == "mirror" ? R"(, "atoms": true)" : "") +
               (mode_ == "square" ? R"(, "domain": "square")" : "") + "}\n");
    std::fflush(stdout);
  }

  static bool next(Query& query) {
    char line[256], kind[16];
    if (std::fgets(line, sizeof line, stdin) == nullptr) return false;
    query.line = line;
    if (std::sscanf(line, R"({"query": %d, "kind": "%15[a-z]", "count": %zu})", &query.number, kind,
                    &query.count) != 3) {
      throw std::runtime_error("no query: " + query.line);
    }
    query.kind = kind;
    return true;
  }

  void misbehave_before(const Query& query) const {
    if (mode_ == "dies") std::exit(3);
    if (mode_ == "aborts") std::abort();
    if (mode_ == "hangs") hang();
    if (mode_ == "hangs-with-child") {
      if (std::system("sleep 1000 & echo $! >child") != 0) std::exit(1);
      hang();
    }
    if (mode_ == "closes-output") {
      close(STDOUT_FILENO);
      hang();
    }
    if (mode_ == "closes-input") {
      close(STDIN_FILENO);
      hang();
    }
    if (mode_ == "rubbish") write_text("computing…\n");
    if (mode_ == "no-line") write_text(std::string(1 << 20, 'x'));
    if (mode_ == "other-query")
      write_text(R"({"query": 99})"
                 "\n");
    if (mode_ == "refuses") {
      write_text(R"({"query": )" + std::to_string(query.number) +
                 R"(, "error": "no such BSDF"})"
                 "\n");
    }
    std::fflush(stdout);
  }

  std::vector<T> read_array(std::size_t count) {
    const NpyHeader header = read_npy_header(input_);
    if (header.type != kType || header.rows * header.columns != count) {
      throw std::runtime_error("an array of a query is not as agreed: " + shape_text(header));
    }
    std::vector<T> values(count);
    input_.read(reinterpret_cast<std::byte*>(values.data()), count * sizeof(T));
    return values;
  }

  void read_arrays(const Query& query) {
    wo_ = read_array(3 * query.count);
    (query.kind == "sample" ? u_ : wi_) =
        read_array((query.kind == "sample" ? 2 : 3) * query.count);
  }

  template <class V>
  void write_array(NpyType type, std::size_t rows, std::size_t columns,
                   const std::vector<V>& values, bool badly) const {
    NpyHeader header{type, columns > 1 ? 2 : 1, rows, columns};
    if (badly && mode_ == "shape") header = {type, 2, columns, rows};
    if (badly && mode_ == "count") header.rows -= 1;
    if (badly && mode_ == "huge") header.rows = 4'000'000'000;
    if (badly && mode_ == "type" && type != NpyType::boolean) header.type = NpyType::boolean;
    if (badly && mode_ == "no-header") write_text("these are no numbers");
    write_text(npy_header(header));
    std::size_t bytes = values.size() * sizeof(V);
    if (badly && mode_ == "midway") bytes /= 2;
    if (bytes > 0) std::fwrite(values.data(), 1, bytes, stdout);
    if (badly && mode_ == "midway") {
      std::fflush(stdout);
      hang();
    }
  }

  static T density(const T* wo, const T* wi) {
    return wo[2] > 0 && wi[2] > 0 ? wi[2] / std::numbers::pi_v<T> : 0;
  }
  static T value(const T* wo, const T* wi) {
    return wo[2] > 0 && wi[2] > 0 ? static_cast<T>(0.8) / std::numbers::pi_v<T> : 0;
  }

  void answer(const Query& query, bool badly) {
    const std::size_t n = query.count;
    std::vector<T> pdf(n), f(n);
    if (query.kind == "sample") {
      wi_.resize(3 * n);
      for (std::size_t i = 0; i < n; ++i) sample(&u_[2 * i], &wi_[3 * i]);
    }
    for (std::size_t i = 0; i < n; ++i) {
      pdf[i] = density(&wo_[3 * i], &wi_[3 * i]);
      f[i] = value(&wo_[3 * i], &wi_[3 * i]);
    }
    if (mode_ == "mirror") pdf.assign(n, 0), f.assign(n, 0);
    if (badly && mode_ == "nan") pdf[0] = std::nan("");
    if (query.kind == "pdf") write_array(kType, n, 1, pdf, badly);
    if (query.kind == "eval") write_array(kType, n, 1, f, badly);
    if (query.kind == "sample" && mode_ == "mirror") {
      write_reflections(n);
    } else if (query.kind == "sample") {
      write_samples(n, pdf, badly);
    }
    if (badly && mode_ == "more") write_text("and more");
  }

  /// Uniform on the unit square: there is no wo.
  void answer_for_square(const Query& query) {
    const std::size_t n = query.count;
    const std::vector<T> x = read_array(2 * n), ones(n, T{1});
    write_text(query.line);
    if (query.kind == "sample") write_array(kType, n, 2, x, false);
    write_array(kType, n, 1, ones, false);
    if (query.kind == "sample") {
      write_array(kType, n, 1, ones, false);
      write_array(NpyType::boolean, n, 1, std::vector<char>(n, 1), false);
    }
    std::fflush(stdout);
  }

  /// All of them atoms, which have no density to state.
  void write_reflections(std::size_t n) {
    for (std::size_t i = 0; i < 3 * n; ++i) wi_[i] = i % 3 == 2 ? wo_[i] : -wo_[i];
    write_array(kType, n, 3, wi_, false);
    write_array(kType, 0, 1, std::vector<T>(), false);
    write_array(kType, n, 3, std::vector<T>(3 * n, T{1}), false);
    write_array(NpyType::boolean, n, 1, std::vector<char>(n, 1), false);
    write_array(kType, n, 1, std::vector<T>(n, T{1}), false);
  }

  static void sample(const T* u, T* wi) {
    const T r = std::sqrt(u[0]), phi = 2 * std::numbers::pi_v<T> * u[1];
    wi[0] = r * std::cos(phi), wi[1] = r * std::sin(phi), wi[2] = std::sqrt(1 - u[0]);
  }

  void write_samples(std::size_t n, const std::vector<T>& pdf, bool badly) const {
    std::vector<char> accepted(n);
    for (std::size_t i = 0; i < n; ++i) accepted[i] = wo_[3 * i + 2] > 0 ? 1 : 0;
    if (badly && mode_ == "flag") accepted[0] = 7;
    write_array(kType, n, 3, wi_, badly);
    write_array(kType, n, 1, pdf, badly);
    write_array(kType, n, 1, std::vector<T>(n, static_cast<T>(0.8)), badly);
    write_array(NpyType::boolean, n, 1, accepted, badly);
  }

  std::string mode_;
  int well_;
  Input input_;
  std::vector<T> wo_, wi_, u_;
};

}  // namespace
}  // namespace plumbline::exchange

int main(int argc, char** argv) {
  using plumbline::exchange::Program;
  const std::string mode = argc > 1 ? argv[1] : "well", precision = argc > 2 ? argv[2] : "float32";
  const int well = argc > 3 ? std::atoi(argv[3]) : 1;
  if (precision == "float64") {
    Program<double>(mode, well).run();
  } else {
    Program<float>(mode, well).run();
  }
}

#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include <plumbline/exchange/answerer.h>
#include <plumbline/exchange/npy.h>

namespace plumbline::tests {
namespace {

namespace fs = std::filesystem;
using exchange::Answerer;
using exchange::AnswererError;

constexpr const char* kHello =
    R"({"protocol": "plumbline/1", "name": "batch", "precision": "float64", "numbers": 2, "functions": ["sample", "pdf"]})";

/// A shell script that answers the hello, and every query with a prepared array.
void write_script(const ScratchDirectory& scratch, const std::string& answer) {
  scratch.write("job.sh",
                "set -e; cd \"$PLUMBLINE_EXCHANGE\"\n"
                "if grep -q hello query.json; then cat '" +
                    (scratch / "hello").string() + "' >answer.json; exit; fi\n" + answer);
  scratch.write("hello", std::string(kHello) + "\n");
}

void write_pdf(const fs::path& path, std::size_t rows, double value) {
  std::ofstream file(path, std::ios::binary);
  file << exchange::npy_header({exchange::NpyType::float64, 1, rows, 1});
  for (std::size_t i = 0; i < rows; ++i) {
    file.write(reinterpret_cast<const char*>(&value), sizeof value);
  }
}

std::vector<double> ask_pdfs(const exchange::AnswererOptions& options, std::size_t count) {
  Answerer answerer(options);
  const std::vector<verify::Vec3> directions(count, {0, 0, 1});
  std::vector<double> pdfs(count);
  answerer.pdf(directions, directions, pdfs);
  EXPECT_EQ(answerer.finish(), "");
  return pdfs;
}

TEST(Folder, CommandIsRunForEachQuery) {
  const ScratchDirectory scratch;
  write_script(scratch, "test -s wo.npy -a -s wi.npy; cp '" + (scratch / "pdf.npy").string() +
                            "' .; cp query.json answer.json");
  write_pdf(scratch / "pdf.npy", 5, 0.25);
  const fs::path folder = scratch / "exchange";
  const exchange::AnswererOptions options{"sh '" + (scratch / "job.sh").string() + "'", folder, 60};
  EXPECT_EQ(ask_pdfs(options, 5), std::vector<double>(5, 0.25));
  EXPECT_TRUE(fs::exists(folder / "done"));
  EXPECT_FALSE(fs::exists(folder / "query-1")) << "answered queries are cleared away";
}

TEST(Folder, SomebodyElseMayAnswer) {
  const ScratchDirectory scratch;
  const fs::path folder = scratch / "exchange";
  std::thread somebody([&] {
    for (const char* name : {"query-0", "query-1"}) {
      const fs::path here = folder / name;
      while (!fs::exists(here / "query.json")) std::this_thread::yield();
      if (here.filename() == "query-1") write_pdf(here / "pdf.npy", 3, 2);
      std::ofstream(here / "answer.json")
          << (here.filename() == "query-0" ? kHello : R"({"query": 1})") << "\n";
    }
  });
  const std::vector<double> pdfs = ask_pdfs({"", folder, 60}, 3);
  somebody.join();
  EXPECT_EQ(pdfs, std::vector<double>(3, 2.0));
}

struct BadJob {
  const char* answer;
  const char* message;
  double timeout = 60;  ///< s
};

TEST(Folder, WhatIsWrongIsSaidWithTheQuery) {
  for (const BadJob& job : std::vector<BadJob>{
           {"exit 4", "the program ended with exit status 4"},
           {"exit 0", "the program ended without a file "},
           {"cp query.json answer.json", "its answer has no file "},
           {"printf '\\223NUMPY' >pdf.npy; cp query.json answer.json", "pdf.npy ends too early"},
           {"cp wo.npy pdf.npy; cp query.json answer.json", "has the shape (5, 3); (5,) is wanted"},
           {"sleep 1000", "there is no answer in ", 2},
       }) {
    const ScratchDirectory scratch;
    write_script(scratch, job.answer);
    std::string said = "nothing";
    try {
      ask_pdfs({"sh '" + (scratch / "job.sh").string() + "'", scratch / "exchange", job.timeout},
               5);
    } catch (const AnswererError& error) {
      said = error.what();
    }
    EXPECT_EQ(said.find("query 1 (pdf, 5 values): "), 0u) << said;
    EXPECT_NE(said.find(job.message), std::string::npos) << said;
  }
}

}  // namespace
}  // namespace plumbline::tests

// Answers plumbline (docs/protocol.md) with a compute shader, whose buffers verify.comp describes:
//   c++ -std=c++20 -O2 -o host host.cpp shader.cpp -lvulkan -lSPIRV-Tools
//   plumbline verify --exec './host mine.spv'
// Ends with exit status 2 and a message where there is no device, or the module is not what it
// should be.
#include <vulkan/vulkan.h>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "shader.h"

namespace {

void read_array(void* to, std::size_t bytes) {  // headers are 128 bytes long
  std::array<char, 128> header;
  if (std::fread(header.data(), 1, header.size(), stdin) != header.size() ||
      std::fread(to, 1, bytes, stdin) != bytes) {
    throw Failure("the query ends too early");
  }
}

void write_array(const char* type, std::uint32_t rows, const char* columns, const void* values,
                 std::size_t bytes) {
  std::array<char, 129> header;
  std::snprintf(header.data(), header.size(), "\x93NUMPY%c%c%c%c%-117s\n", 1, 0, 118, 0, "");
  const std::string dictionary = std::string("{'descr': '") + type +
                                 "', 'fortran_order': False, 'shape': (" + std::to_string(rows) +
                                 "," + columns + "), }";
  std::memcpy(header.data() + 10, dictionary.data(), dictionary.size());
  std::fwrite(header.data(), 1, 128, stdout);
  std::fwrite(values, 1, bytes, stdout);
}

void answer(Shader& shader, const char* line, Kind kind, std::uint32_t rows,
            std::uint32_t numbers) {
  read_array(shader.array<float>(kWo), rows * 12UL);
  read_array(shader.array<float>(kGiven), rows * 4UL * (kind == Kind::sample ? numbers : 3));
  shader.run(kind, rows);
  std::fputs(line, stdout);  // an answer begins with the line of its query
  if (kind == Kind::sample) write_array("<f4", rows, " 3", shader.array<float>(kWi), rows * 12UL);
  if (kind != Kind::eval) write_array("<f4", rows, "", shader.array<float>(kPdf), rows * 4UL);
  if (kind != Kind::pdf) write_array("<f4", rows, " 3", shader.array<float>(kValue), rows * 12UL);
  if (kind == Kind::sample) {
    const auto* accepted = shader.array<std::uint32_t>(kAccepted);
    std::vector<char> bytes(rows);
    for (std::uint32_t i = 0; i < rows; ++i) bytes[i] = accepted[i] != 0 ? 1 : 0;
    write_array("|b1", rows, "", bytes.data(), rows);
  }
}

void answer_all(Shader& shader, const std::string& name) {
  shader.run(Kind::about, 1);
  const std::uint32_t numbers = shader.array<std::uint32_t>(kAccepted)[0];
  if (numbers < 1 || numbers > 3) throw Failure("the shader states no NUMBERS from 1 to 3");
  std::printf(
      "{\"protocol\": \"plumbline/1\", \"name\": \"%s\", \"precision\": \"float32\", "
      "\"numbers\": %u, \"functions\": [\"sample\", \"pdf\", \"eval\"]}\n",
      name.c_str(), numbers);
  std::fflush(stdout);
  std::array<char, 256> line;
  for (; std::fgets(line.data(), line.size(), stdin) != nullptr; std::fflush(stdout)) {
    std::array<char, 8> word{};
    std::uint32_t rows = 0;
    if (std::sscanf(line.data(), R"({"query": %*u, "kind": "%7[a-z]", "count": %u)", word.data(),
                    &rows) != 2 ||
        rows > kMostRows) {
      throw Failure(std::string("is no query: ") + line.data());
    }
    const std::string kind = word.data();
    answer(shader, line.data(),
           kind == "sample" ? Kind::sample
           : kind == "pdf"  ? Kind::pdf
                            : Kind::eval,
           rows, numbers);
  }
}

void run(const std::vector<std::string>& arguments) {
  const char* variable = std::getenv("PLUMBLINE_VULKAN_DEVICE");
  std::string device = variable != nullptr ? variable : "", path;
  std::uint64_t seconds = 50;  // plumbline waits for 60
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const bool has_value = i + 1 < arguments.size();
    if (arguments[i] == "--device" && has_value) {
      device = arguments[++i];
    } else if (arguments[i] == "--wait" && has_value) {
      seconds = std::strtoull(arguments[++i].c_str(), nullptr, 10);
    } else if (path.empty() && arguments[i].rfind('-', 0) != 0) {
      path = arguments[i];
    } else {
      path.clear();
      break;
    }
  }
  if (path.empty() || seconds == 0)
    throw Failure("usage: host MODULE.spv [--device NAME] [--wait SECONDS]");
  const Module module = read_module(path);
  const Device found = choose_device(device);
  std::fprintf(stderr, "host: %s\n", static_cast<const char*>(found.properties.deviceName));
  Shader shader(found, module, seconds);
  answer_all(shader, std::filesystem::path(path).stem().string());
}

}  // namespace

int main(int argc, char** argv) {
  int status = 0;
  try {
    run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "host: %s\n", error.what());
    status = 2;
  }
  // Without what would wait for the device: it may never end.
  std::fflush(stdout);
  std::_Exit(status);
}

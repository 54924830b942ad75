#include "shaders.h"

#include <memory>

namespace plumbline::tests {

std::string host_command(const std::string& module) {
  return "LP_NUM_THREADS=0 " PLUMBLINE_SHADER_HOST " " PLUMBLINE_SHADER_MODULES "/" + module +
         ".spv";
}

exchange::SharedAnswerer start_host(const std::string& module) {
  return std::make_shared<exchange::Answerer>(exchange::AnswererOptions{host_command(module), {}});
}

}  // namespace plumbline::tests

#pragma once

#include <string>
#include <vector>

/// The test project that `plumbline init` writes.
namespace plumbline::tools {

struct TemplateFile {
  std::string name;
  std::string text;
};

/// CMake and GoogleTest.
///
/// @param sources  Plumbline's own, for where it is not installed; may be empty
std::vector<TemplateFile> cpp_template(const std::string& sources);

/// pytest.
std::vector<TemplateFile> python_template();

}  // namespace plumbline::tools

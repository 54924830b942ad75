#pragma once

#include <string>

#include <plumbline/exchange/answerer.h>

/// The shaders of examples/vulkan_glsl, as the host runs them.
namespace plumbline::tests {

/// What runs a module: "ggx", "ggx_1" with its first fault.
///
/// Where the device is the CPU it takes no threads of its own: the gate runs tests side by side.
std::string host_command(const std::string& module);

/// The module's program, started.
exchange::SharedAnswerer start_host(const std::string& module);

}  // namespace plumbline::tests

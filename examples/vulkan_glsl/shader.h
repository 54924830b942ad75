#pragma once

#include <vulkan/vulkan.h>

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

/// A compute shader with the arrays that verify.comp describes. Nothing is given back before the
/// process ends.

constexpr std::uint32_t kMostRows = 1'000'000;  ///< no query asks for more

enum class Kind : std::uint32_t { about, sample, pdf, eval };
enum Array : std::uint32_t { kWo, kGiven, kWi, kPdf, kValue, kAccepted, kArrays };

/// What went wrong, for the user.
struct Failure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Module {
  std::vector<std::uint32_t> words;
  std::uint32_t local_size = 0;  ///< of its workgroups (local_size, 1, 1)
};

/// Reads and validates a module, which drivers take for granted, and crash without; and holds its
/// interface against ours.
/// @throws Failure
Module read_module(const std::string& path);

struct Device {
  VkPhysicalDevice handle;
  VkPhysicalDeviceProperties properties;
};

/// The first discrete GPU with that in its name, or else another GPU, or what runs on the CPU.
/// @param part_of_name  empty for any
/// @throws Failure
Device choose_device(const std::string& part_of_name);

/// The shader with its six arrays on one device.
class Shader {
 public:
  /// @param seconds  that a run may take
  Shader(const Device& device, const Module& module, std::uint64_t seconds);

  template <class T>
  T* array(Array a) const {
    return static_cast<T*>(mapped_[a]);
  }

  /// Runs the shader on that many rows and waits for it.
  void run(Kind kind, std::uint32_t rows);

 private:
  void make_device();
  void make_layouts();
  void make_arrays();
  void make_pipeline(const Module& module);
  void make_commands();
  std::uint32_t memory_type(std::uint32_t allowed) const;

  VkPhysicalDevice physical_;
  std::uint32_t local_size_, family_ = 0;
  std::uint64_t seconds_;
  VkDevice device_ = nullptr;
  VkQueue queue_ = nullptr;
  VkDescriptorSetLayout set_layout_ = nullptr;
  VkPipelineLayout layout_ = nullptr;
  VkDescriptorSet set_ = nullptr;
  VkPipeline pipeline_ = nullptr;
  VkCommandBuffer commands_ = nullptr;
  VkFence fence_ = nullptr;
  std::array<void*, kArrays> mapped_{};
};

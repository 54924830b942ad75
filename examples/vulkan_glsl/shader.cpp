#include "shader.h"

#include <spirv-tools/libspirv.hpp>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>

namespace {

constexpr std::array<std::uint32_t, kArrays> kBytesPerRow{12, 12, 12, 4, 12, 4};  // at most
constexpr std::uint64_t kNanoseconds = 1'000'000'000;

/// A call of Vulkan that must succeed.
void require(VkResult result, const std::string& what) {
  if (result == VK_SUCCESS) return;
  if (result == VK_ERROR_DEVICE_LOST) {
    throw Failure("the device was lost, " + what +
                  ": a shader that runs for too long, or writes beyond its buffers?");
  }
  throw Failure(what + " failed: Vulkan's error " + std::to_string(result));
}

using Words = std::vector<std::uint32_t>;

Words read_words(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Failure(path + ": cannot be read");
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  constexpr std::uint32_t kMagic = 0x07230203;
  Words words(bytes.size() / 4);
  std::memcpy(words.data(), bytes.data(), words.size() * 4);
  if (bytes.size() % 4 != 0 || words.size() < 5 || words[0] != kMagic) {
    throw Failure(path + ": is no SPIR-V module");
  }
  return words;
}

/// What drivers take for granted, and crash without.
void validate(const Words& words, const std::string& path) {
  std::string message;
  spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_3);
  tools.SetMessageConsumer([&](spv_message_level_t, const char*, const spv_position_t&,
                               const char* text) { message = text; });
  if (!tools.Validate(words)) throw Failure(path + ": is invalid SPIR-V: " + message);
}

VkInstance make_instance() {
  VkApplicationInfo application{};
  application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  application.apiVersion = VK_API_VERSION_1_3;
  VkInstanceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  info.pApplicationInfo = &application;
  VkInstance instance = nullptr;
  const VkResult result = vkCreateInstance(&info, nullptr, &instance);
  if (result == VK_ERROR_INCOMPATIBLE_DRIVER) {
    throw Failure("no Vulkan driver is installed (mesa-vulkan-drivers runs shaders on any CPU)");
  }
  require(result, "starting Vulkan");
  return instance;
}

std::vector<Device> devices_of(VkInstance instance) {
  std::uint32_t count = 0;
  require(vkEnumeratePhysicalDevices(instance, &count, nullptr), "looking for devices");
  std::vector<VkPhysicalDevice> devices(count);
  require(vkEnumeratePhysicalDevices(instance, &count, devices.data()), "looking for devices");
  std::vector<Device> found;
  for (VkPhysicalDevice device : devices) {
    vkGetPhysicalDeviceProperties(device, &found.emplace_back(Device{device, {}}).properties);
  }
  if (found.empty()) {
    throw Failure("there is no Vulkan device (mesa-vulkan-drivers runs shaders on any CPU)");
  }
  // Discrete GPUs first, then any other GPU, then what runs on the CPU.
  std::stable_sort(found.begin(), found.end(), [](const Device& a, const Device& b) {
    const auto rank = [](const Device& f) {
      const VkPhysicalDeviceType type = f.properties.deviceType;
      return type == VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU ? 0
             : type == VK_PHYSICAL_DEVICE_TYPE_CPU        ? 2
                                                          : 1;
    };
    return rank(a) < rank(b);
  });
  return found;
}

}  // namespace

Module read_module(const std::string& path) {
  Module module{read_words(path)};
  validate(module.words, path);
  constexpr std::uint32_t kEntryPoint = 15, kExecutionMode = 16, kDecorate = 71;
  constexpr std::uint32_t kCompute = 5, kLocalSize = 17, kBinding = 33, kSet = 34;
  const Words& w = module.words;
  bool has_main = false;
  for (std::size_t i = 5; i < w.size(); i += w[i] >> 16) {
    const std::uint32_t code = w[i] & 0xffff;
    if (code == kEntryPoint && w[i + 1] == kCompute) {
      has_main = has_main || std::strcmp(reinterpret_cast<const char*>(&w[i + 3]), "main") == 0;
    } else if (code == kExecutionMode && w[i + 2] == kLocalSize) {
      if (w[i + 4] != 1 || w[i + 5] != 1)
        throw Failure(path + ": its workgroups are not (n, 1, 1)");
      module.local_size = w[i + 3];
    } else if (code == kDecorate && w[i + 2] == kBinding && w[i + 3] >= kArrays) {
      throw Failure(path + ": uses binding " + std::to_string(w[i + 3]) +
                    "; those of verify.comp are 0 to 5");
    } else if (code == kDecorate && w[i + 2] == kSet && w[i + 3] != 0) {
      throw Failure(path + ": uses a descriptor set beside 0");
    }
  }
  if (!has_main) throw Failure(path + R"(: has no compute shader "main")");
  if (module.local_size == 0) throw Failure(path + ": states no local size");
  return module;
}

Device choose_device(const std::string& part_of_name) {
  std::string names;
  for (const Device& f : devices_of(make_instance())) {
    const std::string name = f.properties.deviceName;
    if (name.find(part_of_name) != std::string::npos) return f;
    names += (names.empty() ? "" : ", ") + name;
  }
  throw Failure("no Vulkan device has \"" + part_of_name + "\" in its name; there are: " + names);
}

Shader::Shader(const Device& device, const Module& module, std::uint64_t seconds)
    : physical_(device.handle), local_size_(module.local_size), seconds_(seconds) {
  if (device.properties.apiVersion < VK_API_VERSION_1_2) {
    throw Failure("the device's driver is older than Vulkan 1.2");
  }
  make_device();
  make_layouts();
  make_arrays();
  make_pipeline(module);
  make_commands();
}

void Shader::make_device() {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(physical_, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(physical_, &count, families.data());
  while (family_ < count && (families[family_].queueFlags & VK_QUEUE_COMPUTE_BIT) == 0) ++family_;
  if (family_ == count) throw Failure("the device runs no compute shaders");
  const float priority = 1;
  VkDeviceQueueCreateInfo queue{};
  queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
  queue.queueFamilyIndex = family_;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  // All that the device can do, for whatever the module makes use of.
  VkPhysicalDeviceVulkan12Features features12{};
  features12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
  VkPhysicalDeviceVulkan11Features features11{};
  features11.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES;
  features11.pNext = &features12;
  VkPhysicalDeviceFeatures2 features{};
  features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
  features.pNext = &features11;
  vkGetPhysicalDeviceFeatures2(physical_, &features);
  VkDeviceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  info.pNext = &features;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  require(vkCreateDevice(physical_, &info, nullptr, &device_), "opening the device");
  vkGetDeviceQueue(device_, family_, 0, &queue_);
}

void Shader::make_layouts() {
  std::array<VkDescriptorSetLayoutBinding, kArrays> bindings{};
  for (std::uint32_t i = 0; i < kArrays; ++i) {
    bindings[i] = {i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
  }
  VkDescriptorSetLayoutCreateInfo set_info{};
  set_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
  set_info.bindingCount = kArrays;
  set_info.pBindings = bindings.data();
  require(vkCreateDescriptorSetLayout(device_, &set_info, nullptr, &set_layout_), "a layout");
  const VkPushConstantRange constants{VK_SHADER_STAGE_COMPUTE_BIT, 0, 8};
  VkPipelineLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  info.setLayoutCount = 1;
  info.pSetLayouts = &set_layout_;
  info.pushConstantRangeCount = 1;
  info.pPushConstantRanges = &constants;
  require(vkCreatePipelineLayout(device_, &info, nullptr, &layout_), "a layout");
}

std::uint32_t Shader::memory_type(std::uint32_t allowed) const {
  VkPhysicalDeviceMemoryProperties memory{};
  vkGetPhysicalDeviceMemoryProperties(physical_, &memory);
  constexpr VkMemoryPropertyFlags kShared =
      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  // Cached, if there is such memory: answers are read from it.
  for (const VkMemoryPropertyFlags wanted :
       {kShared | VK_MEMORY_PROPERTY_HOST_CACHED_BIT, kShared}) {
    for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
      const bool may = (allowed >> i & 1) != 0;
      if (may && (memory.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
    }
  }
  throw Failure("the device shares no memory with the host");
}

/// Room for the largest query, mapped for good.
void Shader::make_arrays() {
  const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kArrays};
  VkDescriptorPoolCreateInfo pool_info{};
  pool_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  pool_info.maxSets = 1;
  pool_info.poolSizeCount = 1;
  pool_info.pPoolSizes = &size;
  VkDescriptorPool pool = nullptr;
  require(vkCreateDescriptorPool(device_, &pool_info, nullptr, &pool), "a descriptor pool");
  VkDescriptorSetAllocateInfo set_info{};
  set_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
  set_info.descriptorPool = pool;
  set_info.descriptorSetCount = 1;
  set_info.pSetLayouts = &set_layout_;
  require(vkAllocateDescriptorSets(device_, &set_info, &set_), "a descriptor set");
  for (std::uint32_t i = 0; i < kArrays; ++i) {
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = VkDeviceSize{kMostRows} * kBytesPerRow[i];
    info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    VkBuffer buffer = nullptr;
    require(vkCreateBuffer(device_, &info, nullptr, &buffer), "a buffer");
    VkMemoryRequirements needs{};
    vkGetBufferMemoryRequirements(device_, buffer, &needs);
    VkMemoryAllocateInfo allocation{};
    allocation.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    allocation.allocationSize = needs.size;
    allocation.memoryTypeIndex = memory_type(needs.memoryTypeBits);
    VkDeviceMemory memory = nullptr;
    require(vkAllocateMemory(device_, &allocation, nullptr, &memory), "allocating memory");
    require(vkBindBufferMemory(device_, buffer, memory, 0), "binding memory");
    require(vkMapMemory(device_, memory, 0, VK_WHOLE_SIZE, 0, &mapped_[i]), "mapping memory");
    const VkDescriptorBufferInfo whole{buffer, 0, VK_WHOLE_SIZE};
    VkWriteDescriptorSet write{};
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstSet = set_;
    write.dstBinding = i;
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    write.pBufferInfo = &whole;
    vkUpdateDescriptorSets(device_, 1, &write, 0, nullptr);
  }
}

void Shader::make_pipeline(const Module& module) {
  VkShaderModuleCreateInfo module_info{};
  module_info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  module_info.codeSize = module.words.size() * 4;
  module_info.pCode = module.words.data();
  VkComputePipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
  info.layout = layout_;
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.pName = "main";
  require(vkCreateShaderModule(device_, &module_info, nullptr, &info.stage.module),
          "reading the shader");
  require(vkCreateComputePipelines(device_, nullptr, 1, &info, nullptr, &pipeline_),
          "compiling the shader");
}

void Shader::make_commands() {
  VkCommandPoolCreateInfo pool_info{};
  pool_info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  pool_info.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
  pool_info.queueFamilyIndex = family_;
  VkCommandPool pool = nullptr;
  require(vkCreateCommandPool(device_, &pool_info, nullptr, &pool), "a command pool");
  VkCommandBufferAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  info.commandPool = pool;
  info.commandBufferCount = 1;
  require(vkAllocateCommandBuffers(device_, &info, &commands_), "a command buffer");
  VkFenceCreateInfo fence_info{};
  fence_info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
  require(vkCreateFence(device_, &fence_info, nullptr, &fence_), "a fence");
}

void Shader::run(Kind kind, std::uint32_t rows) {
  VkCommandBufferBeginInfo begin{};
  begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  require(vkBeginCommandBuffer(commands_, &begin), "a command buffer");
  vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_);
  vkCmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1, &set_, 0,
                          nullptr);
  const std::array<std::uint32_t, 2> query{static_cast<std::uint32_t>(kind), rows};
  vkCmdPushConstants(commands_, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof query,
                     query.data());
  vkCmdDispatch(commands_, (rows + local_size_ - 1) / local_size_, 1, 1);
  VkMemoryBarrier written{};
  written.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
  written.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
  written.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
  vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_PIPELINE_STAGE_HOST_BIT,
                       0, 1, &written, 0, nullptr, 0, nullptr);
  require(vkEndCommandBuffer(commands_), "a command buffer");
  VkSubmitInfo submit{};
  submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands_;
  require(vkQueueSubmit(queue_, 1, &submit, fence_), "starting the shader");
  const VkResult result = vkWaitForFences(device_, 1, &fence_, VK_TRUE, seconds_ * kNanoseconds);
  if (result == VK_TIMEOUT) {
    throw Failure("the shader has not ended within " + std::to_string(seconds_) + " s");
  }
  require(result, "running the shader");
  require(vkResetFences(device_, 1, &fence_), "a fence");
}

#pragma once

#include <algorithm>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include <plumbline/renderer/scene_file/nearest_name.h>

namespace plumbline::renderer {

/// Things that a file may name, in the order in which a message lists them.
template <class T>
class Named {
 public:
  Named(std::initializer_list<std::pair<std::string, T>> entries) : entries_(entries) {}

  /// @return nullptr if there is nothing of that name
  const T* find(const std::string& name) const {
    const auto found = std::find_if(entries_.begin(), entries_.end(),
                                    [&](const auto& entry) { return entry.first == name; });
    return found == entries_.end() ? nullptr : &found->second;
  }

  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& [name, unused] : entries_) names.push_back(name);
    return names;
  }

  /// What to write in place of a name that is not there.
  std::string hint(const std::string& name) const { return name_hint(name, names()); }

 private:
  std::vector<std::pair<std::string, T>> entries_;
};

}  // namespace plumbline::renderer

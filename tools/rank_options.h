#pragma once

#include <string>

#include <plumbline/options/options.h>

namespace plumbline::tools {

/// What a command was told about ranks.
struct RankArguments {
  bool asked_for = false;
  double timeout = 60;  ///< [s]
};

/// Adds --mpi, which it returns, and --mpi-timeout.
options::Option add_rank_options(options::Command& command, RankArguments& arguments,
                                 const std::string& meaning);

}  // namespace plumbline::tools

#include "rank_options.h"

namespace plumbline::tools {

options::Option add_rank_options(options::Command& command, RankArguments& arguments,
                                 const std::string& meaning) {
  options::Option ranks = command.add_flag("--mpi", arguments.asked_for, meaning);
  command
      .add("--mpi-timeout", arguments.timeout,
           "A rank that has said nothing for so long ends the job; 60 without it")
      .positive_number()
      .needs("--mpi")
      .type("S");
  return ranks;
}

}  // namespace plumbline::tools

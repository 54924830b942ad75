#include <plumbline/mpi/ranks.h>

#include <plumbline/renderer/core/errors.h>

namespace plumbline::mpi {

std::unique_ptr<Ranks> start_ranks(double /*timeout*/) {
  throw renderer::InputError(
      "--mpi: this build has no MPI; install it (Debian and Ubuntu: libopenmpi-dev openmpi-bin) "
      "and configure with -DPLUMBLINE_MPI=ON");
}

}  // namespace plumbline::mpi

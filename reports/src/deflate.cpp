#include "deflate.h"

#include <zlib.h>

#include <new>

namespace plumbline::reports::detail {

std::string deflate(std::string_view bytes) {
  uLongf size = ::compressBound(bytes.size());
  std::string result(size, '\0');
  const int status = ::compress2(reinterpret_cast<Bytef*>(result.data()), &size,
                                 reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(),
                                 Z_DEFAULT_COMPRESSION);
  if (status != Z_OK) throw std::bad_alloc();  // all else is ruled out by the bound on the size
  result.resize(size);
  return result;
}

}  // namespace plumbline::reports::detail

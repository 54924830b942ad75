#pragma once

#include <vector>

#include "corpus.h"

namespace plumbline::tests::corpus {

enum class Half { correct, open, sealed };

/// Every case of one kind that this build has.
std::vector<Case> all_cases(Half half);

}  // namespace plumbline::tests::corpus

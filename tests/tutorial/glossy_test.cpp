#include "glossy.h"

#include <plumbline/verify/bsdf.h>
#include <plumbline/verify/gtest.h>

namespace verify = plumbline::verify;

TEST(Glossy, SamplesWhatItsPdfSays) {
  verify::BsdfOptions options;
  options.conventions.frame = verify::BsdfConventions::Frame::local_y_up;
  options.conventions.cosine_in_eval = true;
  options.conventions.weight = verify::BsdfConventions::Weight::f_cosine;
  options.conventions.zero_pdf_is_failure = true;
  options.back = false;          // black from below
  options.angles = {0, 40, 80};  // degrees
  PLUMBLINE_EXPECT_PASS(verify::check_bsdf("glossy", tiny::Glossy{}, options));
}

#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include <plumbline/renderer/core/sampling/warps.h>
#include <plumbline/verify/autodiff.h>
#include <plumbline/verify/pair.h>

/// Every warp of the renderer through the contract battery, in one explicit list.
namespace plumbline::tests {
namespace {

using renderer::Vec2;
using renderer::Vec3;
using verify::Domain;

/// A warp with its density, callable in any scalar.
#define PLUMBLINE_WARP(NAME, PDF, POINT, DOMAIN) \
  struct NAME {                                  \
    static constexpr const char* kName = #NAME;  \
    template <class T>                           \
    using Point = POINT<T>;                      \
    static Domain domain() { return DOMAIN; }    \
    template <class T>                           \
    static auto sample(const Vec2<T>& u) {       \
      return renderer::NAME(u);                  \
    }                                            \
    template <class T>                           \
    static T pdf(const POINT<T>& x) {            \
      return renderer::PDF(x);                   \
    }                                            \
  };
PLUMBLINE_WARP(square_to_cosine_hemisphere, square_to_cosine_hemisphere_pdf_w, Vec3,
               Domain::sphere())
PLUMBLINE_WARP(square_to_uniform_hemisphere, square_to_uniform_hemisphere_pdf_w, Vec3,
               Domain::sphere())
PLUMBLINE_WARP(square_to_uniform_sphere, square_to_uniform_sphere_pdf_w, Vec3, Domain::sphere())
PLUMBLINE_WARP(square_to_uniform_disk, square_to_uniform_disk_pdf_a, Vec2, Domain::disk())
PLUMBLINE_WARP(square_to_uniform_triangle, square_to_uniform_triangle_pdf_a, Vec2,
               Domain::triangle())
#undef PLUMBLINE_WARP

using AllWarps =
    testing::Types<square_to_cosine_hemisphere, square_to_uniform_hemisphere,
                   square_to_uniform_sphere, square_to_uniform_disk, square_to_uniform_triangle>;

template <class W>
class Warps : public testing::Test {};

template <class... W>
std::set<std::string> names_of(testing::Types<W...> /*list*/) {
  return {W::kName...};
}

class WarpName {
 public:
  template <class W>
  static std::string GetName(int) {
    return W::kName;
  }
};

TYPED_TEST_SUITE(Warps, AllWarps, WarpName);

template <class W, class T>
verify::SamplingPair warp_pair() {
  using Point = typename W::template Point<T>;
  return verify::sampling_pair<Point>(
      std::string("warp/") + W::kName, W::domain(),
      [](T u, T v) {
        return W::sample(Vec2<T>{u, v});
      },
      [](const Point& x) { return W::template pdf<T>(x); });
}

TYPED_TEST(Warps, KeepTheContractInFloat) {
  const verify::SamplingPair pair = warp_pair<TypeParam, float>();
  const verify::ContractOptions options = contract_options(pair.name);
  for (const verify::CheckResult& r : check_pair(pair, options)) expect_verdict(r);
}

TYPED_TEST(Warps, KeepTheContractInDouble) {
  const verify::SamplingPair pair = warp_pair<TypeParam, double>();
  const verify::ContractOptions options = contract_options(pair.name + "/double");
  for (const verify::CheckResult& r : check_pair(pair, options)) expect_verdict(r);
}

TYPED_TEST(Warps, PdfIsTheInverseJacobian) {
  using W = TypeParam;
  using Point = typename W::template Point<double>;
  const auto sample = [](const auto& u, const auto& v) {
    using T = std::remove_cvref_t<decltype(u)>;
    return std::optional<typename W::template Point<T>>(W::sample(Vec2<T>{u, T(v)}));
  };
  const auto pdf = [](const verify::Vec3& x) {
    return W::template pdf<double>(verify::from_point<Point>(x));
  };
  verify::AutodiffOptions options;
  options.seed = check_seed(W::kName);
  const verify::CheckResult result =
      check_jacobian_autodiff(std::string("warp/") + W::kName, W::domain(), sample, pdf, options);
  EXPECT_EQ(result.samples, 10'000u);  // no warp rejects
  expect_verdict(result);
}

TEST(WarpList, HoldsEveryWarpOfTheRenderer) {
  std::ifstream file(source_file("renderer/core/include/plumbline/renderer/core/sampling/warps.h"));
  ASSERT_TRUE(file);
  std::stringstream text;
  text << file.rdbuf();
  const std::string header = text.str();
  std::set<std::string> declared;
  for (const std::string result : {"Vec2<T> ", "Vec3<T> "}) {
    std::size_t at = 0;
    while ((at = header.find(result + "square_to_", at)) != std::string::npos) {
      at += result.size();
      declared.insert(header.substr(at, header.find('(', at) - at));
    }
  }
  EXPECT_EQ(declared, names_of(AllWarps{}));
}

TEST(AutodiffJacobian, FailsAPdfThatIsOffInTheEighthDigit) {
  const auto sample = [](const auto& u, const auto& v) {
    using T = std::remove_cvref_t<decltype(u)>;
    return std::optional<Vec3<T>>(renderer::square_to_cosine_hemisphere(Vec2<T>{u, T(v)}));
  };
  verify::CheckResult r = check_jacobian_autodiff(
      "warp/cosine, off by 1e-8", Domain::sphere(), sample, [](const verify::Vec3& w) {
        return renderer::square_to_cosine_hemisphere_pdf_w(verify::from_vec3<renderer::Vec3d>(w)) *
               (1 + 1e-8);
      });
  r.expected = verify::Verdict::fail;
  expect_verdict(r);
}

}  // namespace
}  // namespace plumbline::tests

#include <plumbline/renderer/assembly/names.h>

#include <gtest/gtest.h>

#include <string>

namespace plumbline::renderer {
namespace {

TEST(Names, AreTheWordsOfTheCommandLine) {
  EXPECT_EQ(name(SamplerType::independent), "independent");
  EXPECT_EQ(name(SamplerType::sobol), "sobol");
  EXPECT_EQ(name(Backend::batched), "batched");
  EXPECT_EQ(name(Backend::scalar), "scalar");
  EXPECT_EQ(name(LightSelection::uniform), "uniform");
  EXPECT_EQ(name(LightSelection::area), "area");
  EXPECT_EQ(name(LightSelection::power), "power");
  EXPECT_EQ(name(Strategy::one_sample), "one-sample");
  EXPECT_EQ(name(Strategy::average), "average");
}

TEST(Weighting, IsReadAsItIsWritten) {
  for (const std::string text : {"balance", "power=2", "power=1.5", "cutoff=0.1", "maximum"}) {
    const auto weighting = weighting_from_text(text);
    ASSERT_TRUE(weighting) << text;
    EXPECT_EQ(describe(*weighting), text);
  }
  const auto power = weighting_from_text("power=1.5");
  EXPECT_EQ(power->heuristic, Heuristic::power);
  EXPECT_EQ(power->parameter, 1.5f);
}

TEST(Weighting, WithoutAParameterTakesTheUsualOne) {
  EXPECT_EQ(describe(*weighting_from_text("power")), "power=2");
  EXPECT_EQ(describe(*weighting_from_text("cutoff")), "cutoff=0.1");
}

TEST(Weighting, OfAnotherTextIsNone) {
  for (const char* text : {"", "=", "pow", "power=", "power=x", "power=2x", "power=0", "power=-1",
                           "power=nan", "cutoff=-0.1", "cutoff=1.1", "balance=1", "maximum=2"}) {
    EXPECT_FALSE(weighting_from_text(text)) << text;
  }
  EXPECT_TRUE(weighting_from_text("cutoff=0"));
  EXPECT_TRUE(weighting_from_text("cutoff=1"));
}

}  // namespace
}  // namespace plumbline::renderer

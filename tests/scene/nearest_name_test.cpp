#include <plumbline/renderer/scene_file/nearest_name.h>

#include <gtest/gtest.h>

#include <string>

namespace plumbline::renderer {
namespace {

TEST(NameHint, IsTheKnownNameWithTheFewestEdits) {
  EXPECT_EQ(name_hint("radus", {"center", "radius", "to_world"}), "did you mean \"radius\"?");
  EXPECT_EQ(name_hint("spheres", {"sphere", "shape"}), "did you mean \"sphere\"?");
}

// Insertions, deletions and substitutions alike, up to half the length of what was written.
TEST(NameHint, IsGivenForAsManyEditsAsHalfTheLength) {
  EXPECT_EQ(name_hint("abcd", {"abxy"}), "did you mean \"abxy\"?");
  EXPECT_EQ(name_hint("abcd", {"axyz"}), "supported: axyz");
  EXPECT_EQ(name_hint("abcd", {"abcdef"}), "did you mean \"abcdef\"?");
  EXPECT_EQ(name_hint("abcd", {"abcdefg"}), "supported: abcdefg");
  EXPECT_EQ(name_hint("abcd", {"bc"}), "did you mean \"bc\"?");
  EXPECT_EQ(name_hint("abcd", {"c"}), "supported: c");
  EXPECT_EQ(name_hint("abcd", {"bcda"}), "did you mean \"bcda\"?");  // one out, one in
}

TEST(NameHint, OfAnEmptyOrALongNameListsAll) {
  EXPECT_EQ(name_hint("", {"a", "bc"}), "supported: a, bc");
  EXPECT_EQ(name_hint(std::string(64, 'a'), {std::string(63, 'a')}),
            "did you mean \"" + std::string(63, 'a') + "\"?");
  EXPECT_EQ(name_hint(std::string(65, 'a'), {std::string(64, 'a')}),
            "supported: " + std::string(64, 'a'));
  EXPECT_EQ(name_hint("a", {}), "");
}

}  // namespace
}  // namespace plumbline::renderer

#include <gtest/gtest.h>
#include <plumbline_tests/support.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <string>

#include "scene_text.h"

/// Files that are made to bring a reader down get a message like any other mistake.
namespace plumbline::tests {
namespace {

std::string repeated(const std::string& text, int times) {
  std::string result;
  result.reserve(text.size() * static_cast<std::size_t>(times));
  for (int i = 0; i < times; ++i) result += text;
  return result;
}

TEST(HostileFile, Of100MBIsRefusedUnread) {
  const ScratchDirectory directory;
  const auto file = directory.write("scene.xml", "<scene");
  std::filesystem::resize_file(file, 100u << 20);
  EXPECT_EQ(refusal_of_file(file),
            "scene.xml: has 104857600 bytes, more than the 16777216 that such a file may have");
}

TEST(HostileFile, MayBeAsLargeAsIsSaid) {
  const ScratchDirectory directory;
  const std::string scene = scene_with("<shape type=\"sphere\"/>");
  const auto file =
      directory.write("scene.xml", scene + std::string((16u << 20) - scene.size(), '\n'));
  EXPECT_EQ(refusal_of_file(file), "");
  std::ofstream(file, std::ios::app) << '\n';
  EXPECT_EQ(refusal_of_file(file),
            "scene.xml: has 16777217 bytes, more than the 16777216 that such a file may have");
}

TEST(HostileFile, OfOneByteIsNotEmpty) {
  EXPECT_EQ(refusal_of_text(""), "scene.xml: is empty");
  EXPECT_NE(refusal_of_text("<"), "scene.xml: is empty");
  EXPECT_NE(refusal_of_text("<"), "");
}

TEST(HostileFile, NestedAHundredThousandDeepIsRefused) {
  EXPECT_EQ(refusal_of_text(repeated("<scene>\n", 100000) + repeated("</scene>", 100000)),
            "scene.xml:33: elements are nested deeper than 32");
}

TEST(HostileFile, NestedAndNeverClosedIsRefused) {
  EXPECT_EQ(refusal_of_text(repeated("<scene>\n", 100000)),
            "scene.xml:100000: is not well-formed XML: Start-end tags mismatch");
}

TEST(HostileFile, WithAHundredThousandAttributesIsRefused) {
  std::string text = "<scene";
  for (int i = 0; i < 100000; ++i) text += " a" + std::to_string(i) + "=\"\"";
  EXPECT_EQ(refusal_of_text(text + "/>"), "scene.xml:1: an element has more than 32 attributes");
}

TEST(HostileFile, WithAHundredThousandIdsIsReadInTime) {
  // Quadratic work here would take minutes.
  std::string body;
  for (int i = 0; i < 100000; ++i) {
    body += "<bsdf type=\"diffuse\" id=\"b" + std::to_string(i) + "\"/>\n";
  }
  EXPECT_EQ(load_body(body + "<shape type=\"sphere\"><ref id=\"b99999\"/></shape>").bsdfs->size(),
            100000u);
}

TEST(HostileFile, WithALongNameGetsAShortMessage) {
  const std::string message =
      refusal_of_text(scene_with("<shape type=\"" + repeated("sphere", 100000) + "\"/>"));
  EXPECT_LT(message.size(), 300u);
  EXPECT_EQ(message.substr(0, 39), "scene.xml:3: <shape> of type \"spheresph");
}

TEST(HostileFile, ThatIsADirectoryIsRefused) {
  const ScratchDirectory directory;
  std::filesystem::create_directory(directory.path() / "scene.xml");
  EXPECT_EQ(refusal_of_file(directory.path() / "scene.xml"),
            "scene.xml: is a directory, not a file");
}

TEST(HostileFile, ThatIsMissingIsRefused) {
  const ScratchDirectory directory;
  EXPECT_EQ(refusal_of_file(directory.path() / "scene.xml"), "scene.xml: there is no such file");
}

TEST(HostileFile, ThatIsAPipeIsRefusedAtOnce) {
  const ScratchDirectory directory;
  const auto pipe = directory.path() / "scene.xml";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(refusal_of_file(pipe), "scene.xml: is not a regular file");
}

TEST(HostileFile, ThatMayNotBeReadIsRefused) {
  if (geteuid() == 0) GTEST_SKIP() << "root may read everything";
  const ScratchDirectory directory;
  const auto file = directory.write("scene.xml", scene_with("<shape type=\"sphere\"/>"));
  std::filesystem::permissions(file, std::filesystem::perms::none);
  EXPECT_EQ(refusal_of_file(file), "scene.xml: cannot be opened: Permission denied");
}

TEST(HostileFile, WithZeroBytesIsRefused) {
  std::string text = scene_with("<shape type=\"sphere\"/>");
  text[text.find("sphere")] = '\0';
  EXPECT_EQ(refusal_of_text(text), "scene.xml:3: holds a zero byte, so it is not UTF-8 text");
}

TEST(HostileFile, WithControlCharactersDoesNotReachTheTerminal) {
  EXPECT_EQ(refusal_of_text(scene_with("<shape type=\"\x1b[31mred\"/>")),
            "scene.xml:3: <shape> of type \"?[31mred\" is not supported; supported: sphere, "
            "rectangle, disk, obj");
}

TEST(HostileFile, UndeclaredEntityIsNotExpanded) {
  EXPECT_EQ(refusal_of_text(scene_with("<shape type=\"&bomb;\"/>")),
            "scene.xml:3: <shape> of type \"&bomb;\" is not supported; supported: sphere, "
            "rectangle, disk, obj");
}

/// <default>s, each `factor` times the one before: a bomb of a few hundred bytes.
std::string multiplying(int factor, int lines) {
  std::string body = "<default name=\"p0\" value=\"billions\"/>\n";
  for (int i = 1; i < lines; ++i) {
    body += "<default name=\"p" + std::to_string(i) + "\" value=\"" +
            repeated("$p" + std::to_string(i - 1), factor) + "\"/>\n";
  }
  return body;
}

TEST(HostileFile, OfParametersThatMultiplyIsRefusedBeforeAValueGrowsLarge) {
  // 8·2^13 = 65,536 bytes are the most; 8·10^4 are more.
  EXPECT_EQ(refusal_of_text(scene_with(multiplying(2, 40))),
            "scene.xml:17: <default name=\"p14\">: $p13 makes the value longer than 65536 bytes");
  EXPECT_EQ(refusal_of_text(scene_with(multiplying(10, 13))),
            "scene.xml:7: <default name=\"p4\">: $p3 makes the value longer than 65536 bytes");
}

TEST(HostileFile, OfALargeParameterUsedOftenIsRefusedBeforeAllOfItIsPutIn) {
  // 64 KiB each, and nearly as much again twice for declaring it: the 255th exceeds 16 MiB.
  const std::string use = "<shape type=\"sphere\" name=\"$p13\"/>\n";
  EXPECT_EQ(refusal_of_text(scene_with(multiplying(2, 14) + repeated(use, 300))),
            "scene.xml:271: <shape name=\"$p13\">: parameters have put in more than 16777216 bytes "
            "up to here");
}

TEST(HostileFile, OfParametersThatNameThemselvesIsRefused) {
  EXPECT_EQ(refusal_of_text(scene_with("<default name=\"a\" value=\"$a\"/>")),
            "scene.xml:3: <default name=\"a\">: no <default> before this line declares $a");
  EXPECT_EQ(refusal_of_text(scene_with("<default name=\"a\" value=\"$b\"/>"
                                       "<default name=\"b\" value=\"$a\"/>")),
            "scene.xml:3: <default name=\"a\">: no <default> before this line declares $b");
}

TEST(HostileFile, CutAnywhereNeverCrashes) {
  const std::string text = scene_with(
      "<default name=\"r\" value=\"1\"/><shape type=\"sphere\"><float name=\"radius\" "
      "value=\"$r\"/><emitter type=\"area\"><rgb name=\"radiance\" value=\"1, 2, "
      "3\"/></emitter></shape>");
  const ScratchDirectory directory;
  // The last character is a line break, without which the file is still whole.
  for (std::size_t length = 0; length + 1 < text.size(); ++length) {
    const auto file = directory.write("scene.xml", text.substr(0, length));
    EXPECT_FALSE(refusal_of_file(file).empty()) << length;
  }
  EXPECT_TRUE(refusal_of_file(directory.write("scene.xml", text)).empty());
}

TEST(HostileFile, WithOneByteChangedNeverCrashes) {
  const std::string text = scene_with(
      "<shape type=\"sphere\"><float name=\"radius\" value=\"1\"/><transform "
      "name=\"to_world\"><rotate x=\"1\" angle=\"30\"/></transform></shape>");
  const ScratchDirectory directory;
  int refused = 0;
  for (std::size_t at = 0; at < text.size(); ++at) {
    for (const char replacement : {'<', '"', '&', '9', '-', '\xff', '\x01'}) {
      std::string changed = text;
      changed[at] = replacement;
      refused += refusal_of_file(directory.write("scene.xml", changed)).empty() ? 0 : 1;
    }
  }
  EXPECT_GT(refused, static_cast<int>(text.size()));
}

}  // namespace
}  // namespace plumbline::tests

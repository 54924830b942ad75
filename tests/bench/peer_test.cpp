#include "peer.h"

#include <gtest/gtest.h>
#include <plumbline_tests/support.h>

#include <chrono>
#include <stdexcept>
#include <string>

#include <plumbline/renderer/image_io/exr.h>

/// Another renderer's command, here scripts of which each does one thing.
namespace plumbline::tests {
namespace {

using bench::Peer;
using bench::PeerJob;

PeerJob job_in(const ScratchDirectory& scratch) {
  return {scratch / "my scene.xml", 2, 1, 64, 7, 3};
}

/// A command of a shell script with all that a job says.
std::string running(const ScratchDirectory& scratch, const std::string& script) {
  scratch.write("peer.sh", script);
  return "sh '" + (scratch / "peer.sh").string() + "' {scene} {xml} {out} {spp} {seed} {threads}";
}

std::string why_not(const std::string& command) {
  try {
    const Peer peer(command);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

std::string failure_of(const ScratchDirectory& scratch, const std::string& script,
                       double limit = 60) {
  try {
    Peer(running(scratch, script)).render(job_in(scratch), std::chrono::duration<double>(limit));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "rendered";
}

void write_picture(const ScratchDirectory& scratch, int width) {
  renderer::Image image;
  image.width = width;
  image.height = 1;
  for (int x = 0; x < width; ++x) image.pixels.push_back({1.0f + static_cast<float>(x), 0, 0});
  write_exr(scratch / "ready.exr", image);
}

TEST(Peer, IsToldWhatToRenderAndItsPictureIsRead) {
  const ScratchDirectory scratch;
  write_picture(scratch, 2);
  const Peer peer(running(scratch, "echo \"$1|$2|$4|$5|$6\" >'" + (scratch / "told").string() +
                                       "'; cp '" + (scratch / "ready.exr").string() + "' \"$3\""));
  const bench::PeerPicture picture = peer.render(job_in(scratch));
  const std::string scene = (scratch / "my scene").string();
  EXPECT_EQ(scratch.read("told"), scene + ".pbrt|" + scene + ".xml|64|7|3\n");
  ASSERT_EQ(picture.luminance.size(), 2u);
  EXPECT_NEAR(picture.luminance[0], 0.2126, 1e-6);
  EXPECT_NEAR(picture.luminance[1], 2 * 0.2126, 1e-6);
  EXPECT_GT(picture.cpu_seconds, 0);
  EXPECT_GE(picture.wall_seconds, 0);
}

TEST(Peer, CostsWhatItAndAllThatItWaitsForTakes) {
  const ScratchDirectory scratch;
  write_picture(scratch, 2);
  const Peer peer(
      running(scratch, "sh -c 'i=0; while [ $i -lt 100000 ]; do i=$((i+1)); done'; cp '" +
                           (scratch / "ready.exr").string() + "' \"$3\""));
  EXPECT_GT(peer.render(job_in(scratch)).cpu_seconds, 0.01);
}

TEST(Peer, ThatFailsIsNamedWithItsCommandAndWhatItSaid) {
  const ScratchDirectory scratch;
  const auto expect_failure = [&](const std::string& script, const std::string& what,
                                  double limit = 60) {
    const std::string why = failure_of(scratch, script, limit);
    EXPECT_NE(why.find(what), std::string::npos) << why;
    EXPECT_NE(why.find("sh " + (scratch / "peer.sh").string()), std::string::npos) << why;
  };
  expect_failure("echo no licence >&2; exit 3", "ended with exit status 3; it said:\nno licence");
  expect_failure("kill -9 $$", "was ended by signal 9; it said nothing");
  expect_failure("exit 0", "out.exr");
  expect_failure("echo text >\"$3\"", "out.exr");
  write_picture(scratch, 3);
  expect_failure("cp '" + (scratch / "ready.exr").string() + "' \"$3\"",
                 "its picture has 3x1 pixels, the scene 2x1");
  const auto start = std::chrono::steady_clock::now();
  expect_failure("sleep 100 & sleep 100", "is killed after 0.2 s", 0.2);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(50));
}

TEST(Peer, ThatCannotBeStartedIsAnError) {
  const ScratchDirectory scratch;
  const Peer peer("/nosuch/renderer {scene} {out} {spp} {seed}");
  EXPECT_THROW(peer.render(job_in(scratch)), std::runtime_error);
}

TEST(Peer, OfACommandThatSaysTooLittleOrTooMuchIsRefused) {
  EXPECT_EQ(why_not("pbrt --nthreads {threads} --spp {spp} --seed {seed} --outfile {out} {scene}"),
            "accepted");
  EXPECT_EQ(why_not(""), "--peer: there is no command");
  EXPECT_EQ(why_not("pbrt {scene} {spp} {seed}"), "--peer: {out} is missing");
  EXPECT_EQ(why_not("pbrt {scene} {out} {seed}"), "--peer: {spp} is missing");
  EXPECT_EQ(why_not("pbrt {scene} {out} {spp}"), "--peer: {seed} is missing");
  EXPECT_EQ(why_not("pbrt {out} {spp} {seed}"),
            "--peer: {scene}, a .pbrt file, or {xml}, Mitsuba's, is missing");
  EXPECT_EQ(why_not("pbrt 'a b"), "--peer: a quote ' is not closed");
  for (const char* name : {"{samples}", "{", "{spp"}) {
    const std::string why = why_not(std::string("pbrt {scene} {out} {spp} {seed} ") + name);
    EXPECT_NE(why.find("of none of the names {out}, {scene}, {seed}, {spp}, {threads}, {xml}"),
              std::string::npos)
        << why;
  }
}

}  // namespace
}  // namespace plumbline::tests

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <hwy/targets.h>

#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/assembly/render.h>
#include <plumbline/renderer/brute_force/brute_force.h>
#include <plumbline/renderer/core/errors.h>
#include <plumbline/renderer/scene_file/load_scene.h>
#include <plumbline_tests/support.h>
#include "brute_force_rays.h"
#include "judge.h"
#include "scenes.h"

/// All primitives against sixteen rays at once, held against Embree, and where the two differ
/// against quad precision.
namespace plumbline::tests {
namespace {

using namespace renderer;
using embree::kPacket;

/// Disks, spheres, rectangles and triangles, tilted, in and beside each other, off the centre.
SceneDescription medley() {
  SceneDescription scene = empty_scene(8, 8);
  const Vec3d u{0.8, 0.36, 0.48}, v{-0.6, 0.48, 0.64}, n = cross(u, v);
  for (int i = 0; i < 6; ++i) {
    const double a = i;
    const Vec3d at{3 + std::cos(a), -2 + std::sin(a), 0.7 * a};
    scene.shapes.push_back({DiskShape{at, normalize(n + u * (0.3 + a)), 0.5}, 0, {}});
    scene.shapes.push_back({SphereShape{at + v, 0.2 + 0.1 * a, i % 2 == 0}, 0, {}});
    scene.shapes.push_back({RectangleShape{at - u, u * 0.9, v * (0.2 + a), i % 3 == 0}, 0, {}});
  }
  MeshShape fan;
  fan.vertices.push_back({3, -2, 2});
  for (std::uint32_t i = 0; i < 9; ++i) {
    const double a = 2 * std::numbers::pi * i / 9;
    fan.vertices.push_back(Vec3d{3, -2, 1} + u * std::cos(a) + v * std::sin(a));
    fan.triangles.push_back({0, 1 + i, 1 + (i + 1) % 9});
  }
  scene.shapes.push_back({std::move(fan), 0, {}});
  return scene;
}

const std::map<std::string, SceneDescription>& scenes() {
  static const std::map<std::string, SceneDescription> all = [] {
    std::map<std::string, SceneDescription> made;
    for (const char* name : {"cornell", "veach", "mixed"}) {
      made[name] = load_scene(source_file(std::string("bench/scenes/") + name + ".xml"));
    }
    made["medley"] = medley();
    return made;
  }();
  return all;
}

struct Packet {
  alignas(64) RTCRayHit16 rays{};

  void set(std::size_t k, const Ray& ray) {
    rays.ray.org_x[k] = ray.origin.x;
    rays.ray.org_y[k] = ray.origin.y;
    rays.ray.org_z[k] = ray.origin.z;
    rays.ray.dir_x[k] = ray.direction.x;
    rays.ray.dir_y[k] = ray.direction.y;
    rays.ray.dir_z[k] = ray.direction.z;
    rays.ray.tnear[k] = kNearest;
    rays.ray.tfar[k] = ray.t_max;
    rays.ray.mask[k] = ~0u;
    rays.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
  }
  void intersect(const Scene& scene) {
    alignas(64) int valid[kPacket];
    for (int& v : valid) v = -1;
    scene.geometry().intersect(valid, rays, embree::Coherence::none);
  }
  void occlude(const Scene& scene) {
    alignas(64) int valid[kPacket];
    for (int& v : valid) v = -1;
    scene.geometry().occluded(valid, rays.ray);
  }
  Answer answer(std::size_t k) const {
    return {rays.hit.geomID[k], rays.hit.primID[k], rays.hit.u[k], rays.hit.v[k], rays.ray.tfar[k]};
  }
};

/// 2⁻²⁴ of the lengths that a distance is computed from, as judge.cpp has it, in double.
double unit_of(const SceneGeometry& geometry, const Ray& ray, const Answer& hit) {
  const Vec3d o = vec_cast<double>(ray.origin), d = vec_cast<double>(ray.direction);
  const auto t = static_cast<double>(hit.t);
  if (hit.kind == kSpheres) {
    const Sphere& s = geometry.spheres[hit.index];
    const Vec3d w = vec_cast<double>(s.center) - o;
    const auto radius = static_cast<double>(s.radius);
    const double most = 0x1p-24 * (length(w) + radius), half = std::abs(t - dot(w, d));
    return most + std::min(most * radius / half, std::sqrt(2 * most * radius));
  }
  const Vec3d n = vec_cast<double>(geometry.primitives[hit.kind][hit.index].normal);
  const Vec3d w =
      vec_cast<double>(is_flat(hit.kind) ? geometry.primitives[hit.kind][hit.index].corners.v0
                                         : geometry.disks[hit.index].center) -
      o;
  return 0x1p-24 * (std::abs(n.x * w.x) + std::abs(n.y * w.y) + std::abs(n.z * w.z) + std::abs(t)) /
         std::abs(dot(n, d));
}

/// How far the two engines' distances may be apart, each by its own rounding.
constexpr double kMostApart = 2 * kMostUlps;

struct Comparison {
  std::size_t rays = 0, met = 0, different = 0, apart = 0, judged = 0, wrong = 0;
  double most_units = 0;  // from the exact distance
  std::string first_fault;

  void judge(const SceneGeometry& geometry, const Ray& ray, const Answer& answer) {
    ++judged;
    const std::string fault = fault_of(geometry, ray, answer);
    wrong += fault.empty() ? 0u : 1u;
    if (first_fault.empty()) first_fault = fault;
    if (answer.kind != RTC_INVALID_GEOMETRY_ID) {
      most_units = std::max(most_units, distance_error(geometry, ray, answer));
    }
  }
};

/// Every ray by both engines; where they differ, and one ray of so many, by the judge.
Comparison compare(const SceneDescription& description, std::size_t rays, std::size_t one_of,
                   const std::function<Ray(HardRays&)>& next, std::uint64_t seed) {
  const Scene ours = made_with(description, Accelerator::brute_force);
  const Scene theirs = made_with(description, Accelerator::embree);
  const SceneGeometry& geometry = ours.geometry();
  HardRays source(geometry, seed);
  Comparison c;
  std::array<Ray, kPacket> asked;
  for (; c.rays < rays; c.rays += kPacket) {
    Packet a;
    for (std::size_t k = 0; k < kPacket; ++k) a.set(k, asked[k] = next(source));
    Packet b = a;
    a.intersect(ours);
    b.intersect(theirs);
    for (std::size_t k = 0; k < kPacket; ++k) {
      const Answer mine = a.answer(k), other = b.answer(k);
      const bool hit = mine.kind != RTC_INVALID_GEOMETRY_ID;
      const bool same = mine.kind == other.kind && (!hit || mine.index == other.index);
      const bool apart = same && hit &&
                         !(std::abs(static_cast<double>(mine.t) - static_cast<double>(other.t)) <=
                           kMostApart * unit_of(geometry, asked[k], mine));
      c.met += hit ? 1u : 0u;
      c.different += same ? 0u : 1u;
      c.apart += apart ? 1u : 0u;
      if (!same || apart || (c.rays + k) % one_of == 0) c.judge(geometry, asked[k], mine);
    }
  }
  return c;
}

void expect_right(const std::string& name, const Comparison& c) {
  fmt::print(
      "{:18} {} rays, {} met; {} ({:.2g}) name another surface than Embree, {} ({:.2g}) another "
      "distance; {} judged in quad precision, distances within {:.2f} units\n",
      name, c.rays, c.met, c.different, double(c.different) / double(c.rays), c.apart,
      double(c.apart) / double(c.rays), c.judged, c.most_units);
  EXPECT_EQ(c.wrong, 0u) << name << ": " << c.first_fault;
  EXPECT_GT(c.met, c.rays / 4) << name;
}

TEST(BruteForce, NamesWhatARayReallyMeets) {
  const std::size_t hard = nightly() ? 100'000'000 : 16'000;
  const std::size_t ordinary = nightly() ? 10'000'000 : 16'000, one_of = nightly() ? 20'000 : 100;
  for (const auto& [name, description] : scenes()) {
    expect_right(name + ", hard", compare(description, hard, one_of, &HardRays::next,
                                          check_seed("brute force/hard/" + name)));
    expect_right(name + ", ordinary", compare(description, ordinary, one_of, &HardRays::ordinary,
                                              check_seed("brute force/ordinary/" + name)));
  }
}

TEST(BruteForce, OneRayHasTheBitsOfSixteenAndIsBlockedWhereItMeetsSomething) {
  for (const auto& [name, description] : scenes()) {
    const Scene scene = made_with(description, Accelerator::brute_force);
    const auto engine = make_brute_force(scene.geometry());
    HardRays hard(scene.geometry(), check_seed("one of sixteen/" + name));
    std::size_t blocked_rays = 0;
    for (int i = 0; i < 500; ++i) {
      Packet sixteen;
      std::array<Ray, kPacket> asked;
      for (std::size_t k = 0; k < kPacket; ++k) {
        asked[k] = hard.next();
        if (i % 2 == 0) asked[k].t_max = asked[k].origin.x * asked[k].origin.x + 1;
        sixteen.set(k, asked[k]);
      }
      Packet blocked = sixteen;
      sixteen.intersect(scene);
      blocked.occlude(scene);
      for (std::size_t k = 0; k < kPacket; ++k) {
        const auto one = engine->intersect(asked[k]);
        const Answer of_sixteen = sixteen.answer(k);
        ASSERT_EQ(one.has_value(), of_sixteen.kind != RTC_INVALID_GEOMETRY_ID);
        ASSERT_EQ(engine->occluded(asked[k]), one.has_value());
        ASSERT_EQ(blocked.rays.ray.tfar[k] == -std::numeric_limits<float>::infinity(),
                  one.has_value());
        blocked_rays += one.has_value() ? 1u : 0u;
        if (!one) continue;
        ASSERT_EQ(std::memcmp(&*one, &of_sixteen, sizeof of_sixteen), 0) << name;
      }
    }
    EXPECT_GT(blocked_rays, 500u) << name;
    EXPECT_LT(blocked_rays, 7900u) << name;
  }
}

TEST(BruteForce, ARayMeetsNothingWhereThereIsNothing) {
  // One of each kind, and a ray through the middle of the scene, where rows of zeros would be.
  SceneDescription description = empty_scene(1, 1);
  for (const double side : {-4.0, 4.0}) {
    const Vec3d at{side, side, side};
    description.shapes.push_back({SphereShape{at, 0.5, false}, 0, {}});
    description.shapes.push_back({DiskShape{at, {0, 0, 1}, 0.2}, 0, {}});
    description.shapes.push_back({RectangleShape{at, {0.1, 0, 0}, {0, 0.1, 0.1}, false}, 0, {}});
    description.shapes.push_back(
        {MeshShape{{at, at + Vec3d{0, 0.3, 0}, at + Vec3d{0.2, 0, 0.3}}, {{0, 1, 2}}}, 0, {}});
  }
  const Scene scene = made_with(std::move(description), Accelerator::brute_force);
  const Ray through{{-1, 0, 0}, {1, 0, 0}};
  EXPECT_FALSE(scene.intersect(through));
  EXPECT_FALSE(scene.occluded(through));
  EXPECT_TRUE(scene.intersect({{-4, -4, 0}, {0, 0, -1}}));
}

/// What a packet and each of its rays alone are answered, as it stands in memory.
std::vector<Answer> answers_of(const RayEngine& engine, HardRays rays) {
  std::vector<Answer> answers;
  for (int i = 0; i < 400; ++i) {
    Packet packet;
    std::array<Ray, kPacket> asked;
    for (std::size_t k = 0; k < kPacket; ++k) packet.set(k, asked[k] = rays.next());
    Packet blocked = packet;
    engine.intersect(packet.rays);
    engine.occluded(blocked.rays.ray);
    for (std::size_t k = 0; k < kPacket; ++k) {
      answers.push_back(packet.answer(k));
      answers.push_back({0, 0, 0, 0, blocked.rays.ray.tfar[k]});
      answers.push_back(engine.intersect(asked[k]).value_or(Answer{}));
    }
  }
  return answers;
}

TEST(BruteForce, HasTheSameBitsByEveryInstructionSet) {
  const std::int64_t supported = hwy::SupportedTargets();
  for (const auto& [name, description] : scenes()) {
    const Scene scene = made_with(description, Accelerator::brute_force);
    const auto engine = make_brute_force(scene.geometry());
    const HardRays rays(scene.geometry(), check_seed("sets/" + name));
    const std::vector<Answer> best = answers_of(*engine, rays);
    for (std::int64_t left = supported; left != 0; left &= left - 1) {
      const std::int64_t target = left & -left;
      hwy::SetSupportedTargetsForTest(target);
      const std::vector<Answer> these = answers_of(*engine, rays);
      hwy::SetSupportedTargetsForTest(0);
      EXPECT_EQ(std::memcmp(these.data(), best.data(), best.size() * sizeof best[0]), 0)
          << name << " by " << hwy::TargetName(target);
    }
  }
}

TEST(BruteForce, TheJudgeRefusesWhatIsWrong) {
  // A square at z = 5, and one behind it.
  SceneDescription description = empty_scene(1, 1);
  for (const double z : {5.0, 6.0}) {
    description.shapes.push_back({RectangleShape{{-1, -1, z}, {2, 0, 0}, {0, 2, 0}, true}, 0, {}});
  }
  description.shapes.push_back({SphereShape{{0, 0, -5.5}, 0.5, false}, 0, {}});
  const Scene scene = made_with(description, Accelerator::brute_force);
  const SceneGeometry& geometry = scene.geometry();
  const Ray through{{0.25f, 0.25f, 0}, {0, 0, 1}}, beside{{1.000001f, 0, 0}, {0, 0, 1}};
  const Answer none{RTC_INVALID_GEOMETRY_ID, 0, 0, 0, 0};
  const float z = geometry.primitives[kRectangles][0].corners.v0.z,
              behind = geometry.primitives[kRectangles][1].corners.v0.z;
  EXPECT_EQ(fault_of(geometry, through, {kRectangles, 0, 0, 0, z}), "");
  EXPECT_NE(fault_of(geometry, through, {kRectangles, 1, 0, 0, behind}), "") << "not the nearest";
  EXPECT_NE(fault_of(geometry, through, none), "") << "a miss";
  EXPECT_NE(fault_of(geometry, through, {kRectangles, 0, 0, 0, z * (1 + 40 * 0x1p-23f)}), "")
      << "another distance";
  EXPECT_EQ(fault_of(geometry, beside, none), "");
  EXPECT_NE(fault_of(geometry, beside, {kRectangles, 0, 0, 0, z}), "") << "beside the edge";
  EXPECT_NE(fault_of(geometry, through, {kSpheres, 0, 0, 0, z}), "") << "another surface";
}

TEST(BruteForce, IsChosenByTheNumberOfPrimitives) {
  const auto chosen = [](std::size_t spheres, Accelerator asked) {
    SceneDescription scene = empty_scene(1, 1);
    for (std::size_t i = 0; i < spheres; ++i) {
      scene.shapes.push_back({SphereShape{{double(i), 0, 0}, 0.25, false}, 0, {}});
    }
    return accelerator_of(made_with(std::move(scene), asked));
  };
  EXPECT_EQ(chosen(kMostForBruteForce, Accelerator::automatic), Accelerator::brute_force);
  EXPECT_EQ(chosen(kMostForBruteForce + 1, Accelerator::automatic), Accelerator::embree);
  EXPECT_EQ(chosen(kMostForBruteForce + 1, Accelerator::brute_force), Accelerator::brute_force);
  EXPECT_EQ(chosen(1, Accelerator::embree), Accelerator::embree);
}

TEST(BruteForce, LeavesWhatHasToBeExactToEmbree) {
  SceneDescription scene = empty_scene(1, 1);
  for (const bool flip : {false, true}) {
    scene.shapes.push_back({RectangleShape{{-1, -1, 5}, {2, 0, 0}, {0, 2, 0}, flip}, 0, {}});
  }
  EXPECT_EQ(accelerator_of(made_with(scene, Accelerator::automatic)), Accelerator::embree);
  EXPECT_THROW(made_with(scene, Accelerator::brute_force), InputError);
}

}  // namespace
}  // namespace plumbline::tests

#include <cstddef>
#include <cstdio>
#include <cstring>
#include <vector>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <plumbline/renderer/core/scene/embree.h>

/// What the renderer does with threads, in small: Embree builds a scene, tiles write to places of
/// their own and count by thread, and what they made is read afterwards. The preset `tsan` must say
/// nothing of it. With the argument "race" all tiles count in one place, too, which is all that it
/// must report.
namespace {

constexpr int kTriangles = 20'000;  // enough for Embree to use several threads

RTCScene make_scene(RTCDevice device) {
  RTCScene scene = rtcNewScene(device);
  RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* corners = static_cast<float*>(rtcSetNewGeometryBuffer(
      mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, 3 * kTriangles));
  auto* indices = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, kTriangles));
  for (int i = 0; i < 9 * kTriangles; ++i) corners[i] = static_cast<float>(i * 7919 % 1009);
  for (int i = 0; i < 3 * kTriangles; ++i) indices[i] = static_cast<unsigned>(i);
  rtcCommitGeometry(mesh);
  rtcAttachGeometry(scene, mesh);
  rtcReleaseGeometry(mesh);
  rtcCommitScene(scene);
  return scene;
}

bool is_hit(RTCScene scene, int tile) {
  RTCRay ray{};
  ray.org_x = ray.org_y = static_cast<float>(tile);
  ray.org_z = -1;
  ray.dir_z = 1;
  ray.tfar = 2000;
  ray.mask = ~0u;
  plumbline::renderer::embree::occluded(scene, ray);
  return ray.tfar < 0;
}

}  // namespace

int main(int argc, char** argv) {
  const bool race = argc > 1 && std::strcmp(argv[1], "race") == 0;
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene scene = make_scene(device);
  constexpr int kTiles = 1000;
  std::vector<int> hits(kTiles);
  oneapi::tbb::enumerable_thread_specific<int> by_thread;
  int in_one_place = 0;
  oneapi::tbb::task_arena arena(4);
  for (int pass = 0; pass < 3; ++pass) {
    arena.execute([&] {
      using Range = oneapi::tbb::blocked_range<int>;
      oneapi::tbb::parallel_for(Range(0, kTiles), [&](const Range& range) {
        for (int tile = range.begin(); tile < range.end(); ++tile) {
          for (int ray = 0; ray < 100; ++ray)
            hits[static_cast<std::size_t>(tile)] += is_hit(scene, tile);
          ++by_thread.local();
          if (race) ++in_one_place;
        }
      });
    });
  }
  int sum = in_one_place;
  for (const int hit : hits) sum += hit;
  for (const int tiles : by_thread) sum += tiles;
  std::printf("%zu threads, %d\n", by_thread.size(), sum);
  rtcReleaseScene(scene);
  rtcReleaseDevice(device);
}

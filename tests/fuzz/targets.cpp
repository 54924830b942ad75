#include "targets.h"

#include <filesystem>
#include <string>

#include <plumbline/renderer/assembly/description.h>
#include <plumbline/renderer/assembly/render.h>
#include <plumbline/renderer/image_io/exr.h>
#include <plumbline/renderer/scene_file/load_scene.h>
#include <plumbline/reports/exchange_messages.h>
#include <plumbline/reports/page.h>
#include <plumbline/reports/results.h>

#include "folder.h"

namespace plumbline::tests {
namespace {

namespace fs = std::filesystem;

/// Four pixels of two samples: enough to meet every shape, BSDF and light of a small scene.
void load_and_render(const fs::path& file) {
  may_refuse([&] {
    const auto description = renderer::load_scene(file, {}, renderer::FilmSize{2, 2});
    renderer::RenderOptions options;
    options.samples_per_pixel = 2;
    options.threads = 1;
    options.path.max_depth = 4;
    render(make_scene(description), options);
  });
}

/// A scene around the file that is under test.
std::string scene_with(const std::string& element) {
  return "<scene version=\"3.0.0\"><sensor type=\"perspective\"/>" + element + "</scene>";
}

}  // namespace

void fuzz_scene(std::string_view bytes) { load_and_render(folder().write("scene.xml", bytes)); }

void fuzz_mesh(std::string_view bytes) {
  folder().write("mesh.obj", bytes);
  load_and_render(folder().write(
      "scene.xml",
      scene_with("<shape type=\"obj\"><string name=\"filename\" value=\"mesh.obj\"/>"
                 "<emitter type=\"area\"><rgb name=\"radiance\" value=\"1\"/></emitter></shape>")));
}

void fuzz_image(std::string_view bytes) {
  const fs::path file = folder().write("map.exr", bytes);
  may_refuse([&] { write_exr(folder() / "again.exr", renderer::read_exr(file)); });
  load_and_render(
      folder().write("scene.xml", scene_with("<emitter type=\"envmap\"><string name=\"filename\" "
                                             "value=\"map.exr\"/></emitter>")));
}

void fuzz_records(std::string_view bytes) {
  static const fs::path results = [] {
    fs::create_directories(folder() / "results");
    return folder() / "results";
  }();
  folder().write("results/records.jsonl", bytes);
  may_refuse([&] {
    reports::PageInput page;
    page.results = reports::read_results(results);
    reports::make_page(page);
  });
}

void fuzz_exchange(std::string_view bytes) {
  may_refuse([&] { reports::parse_answerer_hello(bytes); });
  may_refuse([&] { reports::parse_answer_line(bytes); });
  may_refuse([&] { reports::parse_verify_options(bytes); });
  may_refuse([&] { reports::parse_waivers(bytes); });
}

}  // namespace plumbline::tests

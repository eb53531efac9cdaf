// Hard cases of bad input and of too much: 25, 30.
#include <cmath>
#include <string>

#include "hard/hard_case.h"
#include "hard/run.h"
#include "hard/scene_text.h"
#include "shodo/shodo.h"

namespace shodo::hard {

CaseResult bad_numbers() {
  Findings found;
  const std::string digits(400, '7');
  const std::string bad[] = {"nan",
                             "NaN",
                             "inf",
                             "-inf",
                             "1e999",
                             "-1e999",
                             "0x1p3",
                             "1,5",
                             "1.5.2",
                             "--1",
                             "1e",
                             "e5",
                             "+",
                             "-",
                             ".",
                             "1_000",
                             "$",
                             "1e+",
                             "1e99999999999999999999"};
  int refusals = 0;
  for (const std::string& number : bad) {
    const std::string texts[] = {
        "shodo 1\nmaterial white diffuse 0.5\nobject o\nquad white 0 0 0  1 0 0  1 1 " + number + "  0 1 0\n",
        "shodo 1\nmaterial white diffuse 0.5\n\nlight l point at 0 " + number + " 0 intensity 5\n",
        "shodo 1\n\n\nmaterial white diffuse " + number + "\n",
        "shodo 1\n\n\ncamera c eye 0 0 0 look 1 1 1 up 0 0 1 fov " + number + "\n"};
    for (const std::string& text : texts) {
      const FullRun run(text);
      ++refusals;
      found.demand(run.status.code == StatusCode::kScene && run.status.line == 4, number + " refused with its line");
    }
  }
  for (const char* text : {"shodo 1\nmaterial white diffuse\n", "shodo 1\nmaterial white diffuse \"\"\n",
                           "shodo 1\nmaterial white diffuse 1e308\n", "shodo 1\nmaterial white diffuse -1e308\n"}) {
    const FullRun run(text);
    ++refusals;
    found.demand(run.status.code == StatusCode::kScene && run.status.line == 2, "a line number");
  }
  // Too large for a square: refused or finite, never infinite.
  for (const std::string& huge :
       {std::string("1e308"), std::string("1e200"), std::string("1e150"), "1" + digits.substr(0, 300)}) {
    const FullRun run("shodo 1\nmaterial white diffuse 0.5\nobject o\nquad white 0 0 0  " + huge + " 0 0  " + huge +
                      " 1 0  0 1 0\nlight l point at 0.5 0.5 1 intensity 100\n");
    found.demand(run.status.code == StatusCode::kScene || (run.done() && run.sound()), huge + " refused or finite");
    refusals += run.done() ? 0 : 1;
  }
  {
    const FullRun run("shodo 1\nmaterial white diffuse 0.5\nobject o\nquad white 0 0 0  " + digits +
                      " 0 0  1 1 0  0 1 0\n");
    ++refusals;
    found.demand(run.status.code == StatusCode::kScene && run.status.line == 4,
                 "a number of 400 digits beyond 1e308 refused");
  }
  // -0, denormals, and 400 digits that make an ordinary number are numbers.
  for (const std::string& good : {std::string("-0"), std::string("1e-320"), std::string("5e-324"),
                                  std::string("1e-999"), "0." + digits, digits + "e-400"}) {
    const FullRun run("shodo 1\nmaterial white diffuse 0.5\nobject o\nquad white 0 0 " + good +
                      "  1 0 0  1 1 0  0 1 0 patches 1 1\n"
                      "light l point at 0.5 0.5 1 intensity 100\n");
    found.demand(run.done() && run.sound() && run.patches() == 1, good.substr(0, 20) + " taken");
  }
  found.worst(refusals);
  return found.refused(
      "bad numbers refused, each with its line; -0, denormals and 400 digits of an ordinary number are taken");
}

namespace {

/// A room of about `patches` patches.
std::string large_room(int patches) {
  SceneText scene;
  scene.material("white", 0.5);
  scene.object("room");
  const int n = static_cast<int>(std::lround(std::sqrt(patches / 6.0)));
  scene.room({0, 0, 0}, {6, 5, 3}, n, 1);
  scene.point_light({2, 2, 2}, 100);
  scene.camera("eye", {1, 1, 1}, {6, 4, 1.5}, {0, 0, 1}, 90);
  return scene.text();
}

}  // namespace

CaseResult patches_1e5() {
  Findings found;
  const std::string text = large_room(100000);
  Options options = small_picture();
  options.rules.blocks = true;
  // Memory for nothing, for the scene, and for all but a byte: refused before anything is lit, and the need is told.
  std::uint64_t needed = 0;
  std::unique_ptr<std::byte[]> memory(new std::byte[std::size_t{1} << 28]);
  for (std::size_t bytes : {std::size_t{1} << 10, std::size_t{1} << 16, std::size_t{1} << 20, std::size_t{8} << 20}) {
    Model* model = nullptr;
    Status status = load("large.scn", text, {}, options, memory.get(), bytes, model);
    if (status.done()) {
      status = solve(*model, {});
      if (status.done()) break;
      found.demand(statistics(*model).segments_direct == 0, "nothing lit");
      needed = status.bytes_needed;
      found.demand(needed == smallest_memory(*model, false), "the smallest that works told");
    }
    found.demand(status.code == StatusCode::kMemory && status.bytes_needed > bytes,
                 say("a refusal with the need at %zu bytes", bytes));
  }
  Model* model = nullptr;
  Status status = load("large.scn", text, {}, options, memory.get(), std::size_t{1} << 28, model);
  found.demand(status.done(), "the scene loaded with 256 MiB");
  if (!status.done()) return found.result("");
  needed = smallest_memory(*model);
  found.worst(static_cast<double>(needed));
  status = load("large.scn", text, {}, options, memory.get(), needed - 8, model);
  if (status.done()) status = solve(*model, {});
  if (status.done()) status = draw(*model, {}, {});
  found.demand(status.code == StatusCode::kMemory, "8 bytes less refused");
  if (thorough()) {
    // With the smallest memory it finishes.
    status = load("large.scn", text, {}, options, memory.get(), needed, model);
    if (status.done()) status = solve(*model, {});
    found.demand(status.done(),
                 say("an end in %llu bytes: %s", static_cast<unsigned long long>(needed), status.message));
    found.demand(statistics(*model).memory_peak <= needed, "within the budget");
  }
  return found.refused(
      "bytes that 1e5 patches need with blocks: less is refused before anything is lit, and the need told");
}

}  // namespace shodo::hard

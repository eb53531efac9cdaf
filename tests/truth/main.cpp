// What the light of a scene should be, and how far maps are from it (doc/proof.md, A judge that shares nothing).
//
//   truth SCENE [--paths N] [--threads N] [--effects off] [--reflect K] [--senders LIGHT.csv] [--direct LIGHT.csv]
//               [-o FILE]
//     a line a sub-patch, two independent estimates of N paths each; textures reflect as on patches K times as fine.
//     With senders, paths end where they meet something first: there each sub-patch has the light of that file; its
//     direct light is the other file's, or with `--direct there` what it is where it is met
//   truth compare TRUTH.csv LIGHT.csv[/FACTOR]... [--worst N]
//     LIGHT: of `shodo map --csv`, FACTOR times as fine, or a truth
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "base/arena.h"
#include "scene/scene_file.h"
#include "support/files.h"
#include "truth/comparison.h"
#include "truth/tracer.h"

namespace {

using namespace shodo;

[[noreturn]] void give_up(const std::string& why) {
  std::fprintf(stderr, "truth: %s\n", why.c_str());
  std::exit(1);
}

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) give_up(path + ": can't be read");
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

struct Words {
  std::vector<std::string> plain;
  std::string output = "-", senders, direct;
  std::uint32_t paths = 256;
  unsigned threads = 1;
  std::size_t worst = 0;
  bool effects = true;
  double reflect = 1;
};

Words words_of(int count, char** word) {
  Words words;
  for (int k = 1; k < count; ++k) {
    const std::string name = word[k];
    if (name.size() < 2 || name[0] != '-') {
      words.plain.push_back(name);
      continue;
    }
    if (++k == count) give_up(name + " wants a value");
    const std::string value = word[k];
    if (name == "-o") words.output = value;
    else if (name == "--senders") words.senders = value;
    else if (name == "--direct") words.direct = value;
    else if (name == "--paths") words.paths = static_cast<std::uint32_t>(std::strtoul(value.c_str(), nullptr, 10));
    else if (name == "--threads") words.threads = static_cast<unsigned>(std::strtoul(value.c_str(), nullptr, 10));
    else if (name == "--worst") words.worst = std::strtoul(value.c_str(), nullptr, 10);
    else if (name == "--reflect") words.reflect = std::strtod(value.c_str(), nullptr);
    else if (name == "--effects") words.effects = value != "off";
    else give_up(name + " is no option");
  }
  if (words.plain.empty() || words.paths == 0) give_up("see the head of tests/truth/main.cpp");
  return words;
}

/// Of a sub-patch in tables.
truth::Key key_of(const Mesh& mesh, std::uint32_t m, std::uint32_t local) {
  const PieceIndex index = sub_patch_index(mesh, local);
  const bool triangle = mesh.kind == MeshKind::kTriangle;
  return {m, index.v, triangle ? 2 * index.u + (index.inverted ? 1 : 0) : index.u};
}

void write_line(std::FILE* file, const Scene& scene, std::uint32_t m, std::uint32_t local, const truth::Truth& truth) {
  const Mesh& mesh = scene.meshes[m];
  const auto [number, v, u] = key_of(mesh, m, local);
  const double area = length(sub_patch_piece(scene, mesh, local).vector_area());
  const std::string name(scene.objects[mesh.object].name);
  std::fprintf(file, "%s,%u,%u,%u,%s,%.9g,%.9g", name.c_str(), number, u, v,
               mesh.kind == MeshKind::kTriangle ? "tri" : "quad", area,
               area * 0.5 * (truth.half[0].seen + truth.half[1].seen));
  for (const truth::Estimate& half : truth.half) {
    for (const double lux : half.lux) std::fprintf(file, ",%.9g", lux);
  }
  for (const truth::Estimate& half : truth.half) {
    for (const double lux : half.direct) std::fprintf(file, ",%.9g", lux);
  }
  std::fprintf(file, "\n");
}

/// A scene and the memory in which it lies.
struct Loaded {
  Loaded(const std::string& path, bool effects, double refine)
      : memory(new std::byte[kBytes]), arena(memory.get(), kBytes) {
    const std::size_t slash = path.rfind('/');
    FolderReader reader(slash == std::string::npos ? "." : path.substr(0, slash));
    Options options;
    options.effects = effects;
    options.refine = refine;
    const Status status = load_scene(path, text_of(path), reader.reader(), options, arena, scene);
    if (!status.done()) give_up(path + ":" + std::to_string(status.line) + ": " + status.message);
  }
  static constexpr std::size_t kBytes = std::size_t{256} << 20;
  std::unique_ptr<std::byte[]> memory;
  Arena arena;
  Scene scene;
};

bool lit_there(const Words& words) { return words.direct == "there"; }

truth::Tracer::Senders senders_of(const Scene& scene, const Words& words) {
  truth::Table kinds;
  const auto for_all = [&](auto act) {
    for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
      const Mesh& mesh = scene.meshes[m];
      for (std::uint32_t k = 0; k < mesh.sub_patch_count(); ++k) {
        act(mesh, mesh.first_sub_patch + k, key_of(mesh, m, k));
      }
    }
  };
  for_all([&](const Mesh& mesh, std::uint32_t, const truth::Key& key) {
    kinds[key].triangle = mesh.kind == MeshKind::kTriangle;
  });
  truth::Table sent = truth::read_light(text_of(words.senders), kinds, 1), direct = sent;
  if (lit_there(words)) {
    direct.clear();
  } else if (!words.direct.empty()) {
    direct = truth::read_light(text_of(words.direct), kinds, 1);
  }
  truth::Tracer::Senders senders(scene.sub_patch_count);
  for_all([&](const Mesh&, std::uint32_t number, const truth::Key& key) {
    for (std::size_t c = 0; c < 3; ++c) {
      senders[number][c] = 0.5 * (sent[key].ambient[0][c] + sent[key].ambient[1][c]) +
                           0.5 * (direct[key].direct[0][c] + direct[key].direct[1][c]);
    }
  });
  return senders;
}

int find_truth(const Words& words) {
  const Loaded loaded(words.plain[0], words.effects, 1), reflecting(words.plain[0], words.effects, words.reflect);
  const Scene& scene = loaded.scene;
  truth::Tracer tracer(scene, reflecting.scene);
  if (!words.senders.empty()) tracer.end_at(senders_of(scene, words), lit_there(words));
  const std::vector<truth::Truth> truths = tracer.all(words.paths, words.threads);
  std::FILE* const file = words.output == "-" ? stdout : std::fopen(words.output.c_str(), "w");
  if (file == nullptr) give_up(words.output + ": can't be written");
  std::fprintf(file, "%s\n", truth::kTruthHead);
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
    const Mesh& mesh = scene.meshes[m];
    for (std::uint32_t k = 0; k < mesh.sub_patch_count(); ++k) {
      write_line(file, scene, m, k, truths[mesh.first_sub_patch + k]);
    }
  }
  return std::fclose(file) == 0 ? 0 : 1;
}

int compare(const Words& words) {
  if (words.plain.size() < 3) give_up("compare wants a truth and maps");
  const truth::Table told = truth::read_truth(text_of(words.plain[1]));
  for (std::size_t k = 2; k < words.plain.size(); ++k) {
    std::string name = words.plain[k];
    std::uint32_t factor = 1;
    const std::size_t slash = name.rfind('/');
    if (slash != std::string::npos && name.find_first_not_of("0123456789", slash + 1) == std::string::npos) {
      factor = static_cast<std::uint32_t>(std::strtoul(name.c_str() + slash + 1, nullptr, 10));
      name.resize(slash);
    }
    if (factor == 0) give_up("a factor is from 1");
    const truth::Table map = truth::read_light(text_of(name), told, factor);
    std::fputs(truth::comparison(words.plain[k], told, map, words.worst).c_str(), stdout);
  }
  return 0;
}

}  // namespace

int main(int count, char** word) {
  const Words words = words_of(count, word);
  return words.plain[0] == "compare" ? compare(words) : find_truth(words);
}

// The file is gone through four times: what is in it is counted; vertices and names of materials are kept; the MTL
// files are read, when all names are known that they are asked for; and the faces are added, when all vertices and
// materials are there. So an index may name a vertex that comes later, and an MTL file may be named after the first
// `usemtl`.
#include "scene/obj_file.h"

#include "base/check.h"
#include "base/decimal.h"
#include "base/sort.h"
#include "scene/faces.h"
#include "scene/model_words.h"
#include "scene/mtl_file.h"
#include "scene/polygon_cut.h"
#include "scene/quad_shape.h"
#include "scene/slice.h"

namespace shodo {

namespace {

constexpr std::uint32_t kMostLibraries = 64;  // each may be as long as it likes

enum class ObjWord : std::uint8_t { kVertex, kFace, kMaterial, kLibrary, kSkipped, kFreeForm, kUnknown };

// Those that start a statement, besides the five that are read. What is skipped has no surface, or is about how one is
// shown; `call`, `csh` and the superseded `bsp bzp cdc cdp` are unknown: they would bring geometry.
constexpr std::string_view kSkipped[] = {"vt",    "vn",    "vp",       "g",        "o",         "s",
                                         "mg",    "l",     "p",        "bevel",    "c_interp",  "d_interp",
                                         "lod",   "maplib", "usemap",  "shadow_obj", "trace_obj"};
constexpr std::string_view kFreeForm[] = {"cstype", "deg",  "bmat", "step", "curv", "curv2", "surf",  "parm",
                                          "trim",   "hole", "scrv", "sp",   "end",  "con",   "ctech", "stech"};

ObjWord kind_of(std::string_view word) {
  if (word == "v") return ObjWord::kVertex;
  if (word == "f" || word == "fo") return ObjWord::kFace;  // fo: as it was called once
  if (word == "usemtl") return ObjWord::kMaterial;
  if (word == "mtllib") return ObjWord::kLibrary;
  for (const std::string_view skipped : kSkipped) {
    if (word == skipped) return ObjWord::kSkipped;
  }
  for (const std::string_view free_form : kFreeForm) {
    if (word == free_form) return ObjWord::kFreeForm;
  }
  return ObjWord::kUnknown;
}

/// A rotation by a multiple of 90 degrees is exact.
class Placing {
 public:
  explicit Placing(const ModelPlace& place) : place_(place) {
    const double angle[3] = {place.turn.x, place.turn.y, place.turn.z};
    for (int k = 0; k < 3; ++k) {
      sine_[k] = sine_degrees(angle[k]);
      cosine_[k] = cosine_degrees(angle[k]);
    }
  }
  Vec3 operator()(const Vec3& p) const {
    Vec3 q = place_.scale * p;
    q = {q.x, cosine_[0] * q.y - sine_[0] * q.z, sine_[0] * q.y + cosine_[0] * q.z};
    q = {cosine_[1] * q.x + sine_[1] * q.z, q.y, cosine_[1] * q.z - sine_[1] * q.x};
    q = {cosine_[2] * q.x - sine_[2] * q.y, sine_[2] * q.x + cosine_[2] * q.y, q.z};
    return q + place_.at;
  }

 private:
  ModelPlace place_;
  double sine_[3] = {}, cosine_[3] = {};
};

bool within_numbers(const Vec3& p) {
  return magnitude(p.x) <= kLargestNumber && magnitude(p.y) <= kLargestNumber && magnitude(p.z) <= kLargestNumber;
}

/// No bytes more than the arena can have are ever asked for: so the sum doesn't wrap around.
std::size_t block_bytes(std::uint64_t count, std::size_t size) {
  constexpr std::size_t kMost = SIZE_MAX / 16;
  return count > kMost / size ? kMost : (static_cast<std::size_t>(count) * size + 7) / 8 * 8;
}

bool before(const ModelMaterial& a, const ModelMaterial& b) {
  if (a.use.text != b.use.text) return a.use.text < b.use.text;
  return a.use.line < b.use.line;
}

class ObjFile {
 public:
  ObjFile(SceneReading& reading, std::string_view path, std::string_view text, const ModelPlace& place,
          std::uint32_t material)
      : reading_(reading), path_(path), text_(text), placing_(place), material_(material) {}

  bool read() {
    if (!each(&ObjFile::count) || !take_scratch() || !each(&ObjFile::keep)) return false;
    if (own_materials()) {
      sort_materials();
      if (!each(&ObjFile::read_libraries) || !add_materials()) return false;
    }
    vertices_so_far_ = 0;
    face_material_ = material_;
    return each(&ObjFile::add_face);
  }

 private:
  using Step = bool (ObjFile::*)(ModelWords& words, const Token& word, ObjWord kind);

  bool own_materials() const { return material_ == kNone; }

  /// One way through the file. A step may leave a statement unread.
  bool each(Step step) {
    ModelWords words(reading_.words, path_, text_);
    if (!words.countable()) return false;
    while (words.next_statement()) {
      const Token word = words.take();
      const ObjWord kind = word.kind == TokenKind::kWord ? kind_of(word.text) : ObjWord::kUnknown;
      if (!(this->*step)(words, word, kind) || !words.skip_statement()) return false;
    }
    return true;
  }

  // ---- first way: what there is, and whether it may be there

  bool count(ModelWords& words, const Token& word, ObjWord kind) {
    switch (kind) {
      case ObjWord::kVertex: ++vertex_count_; return true;
      case ObjWord::kMaterial:
        if (!words.at_word()) return words.expected("the name of a material");
        named_ = true;
        unused_ = true;
        return true;
      case ObjWord::kFace: return count_face(words, word);
      case ObjWord::kFreeForm: return words.expected(word, "faces only: free-form curves and surfaces are left out");
      case ObjWord::kUnknown: return words.expected(word, "a statement of an OBJ file");
      default: return true;
    }
  }

  bool count_face(ModelWords& words, const Token& word) {
    if (own_materials() && !named_) {
      return words.expected(word, "'usemtl' before the first face, or a material beside 'obj'");
    }
    if (unused_) ++use_count_;
    unused_ = false;
    std::uint32_t corners = 0;
    for (; words.at_word(); ++corners) {
      if (corners == kMostCorners) return words.expected("at most 1024 corners of a face");
      words.take();
    }
    if (corners < 3) return words.expected("at least 3 corners of a face");
    if (corners > most_corners_) most_corners_ = corners;
    return true;
  }

  bool take_scratch() {
    const std::uint32_t cut = features::kMeshes && most_corners_ > 4 ? most_corners_ : 0;
    const std::uint64_t uses = own_materials() ? use_count_ : 0;
    const std::size_t bytes = block_bytes(vertex_count_, sizeof(Vec3)) + block_bytes(uses, sizeof(ModelMaterial)) +
                              block_bytes(most_corners_, sizeof(Vec3)) + block_bytes(cut, sizeof(CutCorner)) +
                              block_bytes(cut, sizeof(CutTriangle));
    Arena& arena = reading_.arena;
    const Arena::Mark mark = arena.mark();
    std::span<std::byte> everything;
    bool fits = arena.take("a model", bytes, everything);
    arena.release(mark);
    fits = fits && arena.take("a model", static_cast<std::size_t>(vertex_count_), vertices_) &&
           arena.take("a model", static_cast<std::size_t>(uses), materials_) &&
           arena.take("a model", most_corners_, corners_) && arena.take("a model", cut, cut_corners_) &&
           arena.take("a model", cut, triangles_);
    if (!fits) reading_.status = arena.refused();
    return fits;
  }

  // ---- second way: vertices, and the names of materials that a face has

  bool keep(ModelWords& words, const Token& word, ObjWord kind) {
    switch (kind) {
      case ObjWord::kVertex: return keep_vertex(words, word);
      case ObjWord::kMaterial:
        use_ = words.take_name();
        unused_ = true;
        return true;
      case ObjWord::kFace:
        if (unused_ && own_materials()) {
          SHODO_CHECK(used_ < materials_.size());
          materials_[used_++].use = use_;
        }
        unused_ = false;
        return true;
      default: return true;
    }
  }

  /// v X Y Z, and then a weight, a colour or both.
  bool keep_vertex(ModelWords& words, const Token& word) {
    constexpr std::string_view kAxes[3] = {"x", "y", "z"};
    double value[3] = {}, skipped = 0;
    for (std::uint32_t k = 0; k < 3; ++k) {
      if (!words.read_number({"a vertex", 0, kAxes[k]}, kAnyNumber, value[k])) return false;
    }
    for (std::uint32_t k = 0; k < 4 && words.at_word(); ++k) {
      if (!words.read_number({"weight or colour of a vertex"}, kAnyNumber, skipped)) return false;
    }
    const Vec3 placed = placing_({value[0], value[1], value[2]});
    if (!within_numbers(placed)) {
      words.mistake(word).add("expected a vertex that lies within 1e+30 when it is scaled, turned and moved");
      return false;
    }
    SHODO_CHECK(vertices_so_far_ < vertices_.size());
    vertices_[vertices_so_far_++] = placed;
    return words.end_statement();
  }

  /// Ascending, each once, with its first use.
  void sort_materials() {
    heap_sort(materials_, before);
    std::size_t kept = 0;
    for (const ModelMaterial& material : materials_) {
      if (kept == 0 || materials_[kept - 1].use.text != material.use.text) materials_[kept++] = material;
    }
    materials_ = materials_.first(kept);
  }

  // ---- third way: the MTL files

  /// mtllib FILE ..., each looked through for what the ones before don't have. Exporters repeat them for every group.
  bool read_libraries(ModelWords& words, const Token&, ObjWord kind) {
    if (kind != ObjWord::kLibrary) return true;
    if (!words.at_word()) return words.expected("the path of a file");
    while (words.at_word()) {
      const Token file = words.take();
      if (file.text == library_) continue;
      if (libraries_++ == kMostLibraries) return words.expected(file, "at most 64 files of materials");
      library_ = file.text;
      std::string_view path, text;
      if (!reading_.words.read_beside(path_, file, path, text)) return false;
      if (!read_mtl_file(reading_.words, path, text, materials_)) return false;
    }
    return true;
  }

  bool add_materials() {
    const ModelMaterial* missing = nullptr;
    for (ModelMaterial& material : materials_) {
      if (!material.found && (missing == nullptr || material.use.line < missing->use.line)) missing = &material;
      material.index = static_cast<std::uint32_t>(reading_.store.counts().materials);
      reading_.store.add(Material{{}, material.diffuse});
    }
    if (missing == nullptr) return true;
    MessageText message = reading_.words.mistake_in(path_, missing->use);
    message.add("expected the name of a material of an MTL file");
    add_found(message, missing->use);
    return false;
  }

  // ---- fourth way: faces

  bool add_face(ModelWords& words, const Token& word, ObjWord kind) {
    switch (kind) {
      case ObjWord::kVertex: ++vertices_so_far_; return true;
      case ObjWord::kMaterial:
        if (own_materials()) take_material(words.take_name());
        return true;
      case ObjWord::kFace: return read_corners(words) && add_corners(words, word);
      default: return true;
    }
  }

  /// One that no face has isn't among them.
  void take_material(const Token& name) {
    const ModelMaterial* const used = find_model_material(materials_, name.text);
    if (used != nullptr) face_material_ = used->index;
  }

  /// Those that differ from the one before.
  bool read_corners(ModelWords& words) {
    corner_count_ = 0;
    while (words.at_word()) {
      Vec3 corner;
      if (!read_corner(words, corner)) return false;
      if (corner_count_ == 0 || corners_[corner_count_ - 1] != corner) corners_[corner_count_++] = corner;
    }
    while (corner_count_ > 1 && corners_[corner_count_ - 1] == corners_[0]) --corner_count_;
    return true;
  }

  /// V, V/VT, V//VN or V/VT/VN; a negative number counts back from the last vertex above.
  bool read_corner(ModelWords& words, Vec3& corner) {
    const Token at = words.peek();
    const std::size_t slash = at.text.find('/');
    const std::string_view others = slash == std::string_view::npos ? std::string_view() : slice(at.text, slash + 1);
    std::uint32_t slashes = 0;
    bool known = true;
    for (const char c : others) {
      if (c == '/') ++slashes;
      known = known && (c == '/' || c == '-' || (c >= '0' && c <= '9'));
    }
    if (!known || slashes > 1) return words.expected("a corner as V, V/VT, V//VN or V/VT/VN");
    const std::string_view vertex = slice(at.text, 0, slash);
    const bool back = vertex.starts_with('-');
    std::uint32_t index = 0;
    const bool whole = parse_unsigned(back ? slice(vertex, 1) : vertex, index);
    const std::uint64_t most = back ? vertices_so_far_ : vertices_.size();
    if (!whole || index == 0 || index > most) {
      MessageText message = words.mistake(at);
      message.add("expected a vertex");
      if (vertices_.empty()) message.add(", and the file to have any");
      if (!vertices_.empty()) message.add(" from 1 to ").add(vertices_.size());
      if (vertices_so_far_ > 0) message.add(" or, counted back, from -1 to -").add(vertices_so_far_);
      add_found(message, at);
      return false;
    }
    corner = vertices_[static_cast<std::size_t>(back ? vertices_so_far_ - index : index - 1)];
    words.take();
    return true;
  }

  bool add_corners(ModelWords& words, const Token& word) {
    if constexpr (!features::kMeshes) {
      const QuadShape shape = corner_count_ == 4 ? quad_shape(corners_.data()) : QuadShape::kCut02;
      if (corner_count_ >= 3 && shape != QuadShape::kConvex && shape != QuadShape::kNoArea) {
        words.mistake(word).add("this library is built without faces other than convex quads");
        return false;
      }
    }
    if (corner_count_ < 3) {
      ++reading_.store.scene().polygons_dropped;
      return true;
    }
    if (corner_count_ == 4) return add_whole_quad(words, word);
    if (!features::kMeshes || corner_count_ == 3) return add_one_triangle(corners_.data());
    return add_polygon(words, word);
  }

  bool begin_face(Mesh& mesh) {
    mesh.material = face_material_;
    return begin_mesh(reading_, mesh);
  }

  bool add_one_triangle(const Vec3* corner) {
    Mesh mesh;
    return begin_face(mesh) && add_triangle(reading_, mesh, corner, kOnePatch);
  }

  bool add_whole_quad(ModelWords& words, const Token& word) {
    const QuadShape shape = quad_shape(corners_.data());
    Mesh mesh;
    if (shape != QuadShape::kCrossing) {
      return begin_face(mesh) && add_quad(reading_, mesh, corners_.data(), shape, kOnePatch);
    }
    words.mistake(word).add("expected a quad that does not cross itself or fold over");
    return false;
  }

  bool polygon_has_area() const {
    for (std::uint32_t k = 1; k + 1 < corner_count_; ++k) {
      if (triangle_has_area(corners_[0], corners_[k], corners_[k + 1])) return true;
    }
    return false;
  }

  bool add_polygon(ModelWords& words, const Token& word) {
    if (!polygon_has_area()) {
      ++reading_.store.scene().polygons_dropped;
      return true;
    }
    const std::uint32_t count = cut_polygon(corners_.first(corner_count_), cut_corners_, triangles_);
    if (count == 0) {
      words.mistake(word).add("expected a polygon that lies in a plane and does not cross itself");
      return false;
    }
    for (const CutTriangle& triangle : triangles_.first(count)) {
      Vec3 corner[3];
      for (std::uint32_t k = 0; k < 3; ++k) corner[k] = corners_[triangle.corner[k]];
      // One that is as thin as the rounding before the cut is no face of the file's.
      const bool has_area = triangle_has_area(corner[0], corner[1], corner[2]);
      if (has_area && !add_one_triangle(corner)) return false;
    }
    return true;
  }

  static constexpr GivenCounts kOnePatch{1, 1, 0, 0};

  SceneReading& reading_;
  const std::string_view path_, text_;
  const Placing placing_;
  const std::uint32_t material_;  // kNone: the model's own

  std::uint64_t vertex_count_ = 0, use_count_ = 0;
  std::uint32_t most_corners_ = 0;
  bool named_ = false;   // there was a usemtl
  bool unused_ = false;  // and no face since
  Token use_;
  std::size_t used_ = 0;

  std::span<Vec3> vertices_;
  std::span<ModelMaterial> materials_;
  std::size_t vertices_so_far_ = 0;
  std::string_view library_;  // the last one
  std::uint32_t libraries_ = 0;

  std::span<Vec3> corners_;
  std::span<CutCorner> cut_corners_;
  std::span<CutTriangle> triangles_;
  std::uint32_t corner_count_ = 0;
  std::uint32_t face_material_ = 0;  // of the scene
};

}  // namespace

bool read_obj_file(SceneReading& reading, std::string_view path, std::string_view text, const ModelPlace& place,
                   std::uint32_t material) {
  const ArenaScratch scratch(reading.arena);
  return ObjFile(reading, path, text, place, material).read();
}

}  // namespace shodo

// The paper's table (3.3) with ours beside it, and what the lossless flags save.
#include <algorithm>

#include "cli/report_tables.h"

namespace shodo {

namespace {

/// What the paper gives of a room (3.3), before and after its flags.
struct PaperRoom {
  std::string_view name;
  std::uint32_t patches, sub_patches;
  struct {
    double direct, form_factors, solution;
    std::uint32_t nonzeros;
  } without, with;
  double picture;
  double total;  // with flags
};

constexpr PaperRoom kPaperRooms[] = {
    {"day", 1526, 8006, {838, 6038, 0.5, 76681}, {226, 28, 1, 142262}, 290, 545},
    {"evening", 1526, 10086, {639, 9185, 0.8, 99542}, {97, 32, 2, 213836}, 290, 421},
};

const PaperRoom* paper_room(const std::string& name) {
  for (const PaperRoom& room : kPaperRooms) {
    if (room.name == name) return &room;
  }
  return nullptr;
}

/// One of our columns: a case that was run.
struct OurColumn {
  std::string name, title;
  const CaseResult* result;
};

std::vector<OurColumn> our_columns(const SceneResults& scene) {
  constexpr Rules kNone{};
  constexpr Rules kAll{.rule1 = true, .rule2 = true, .rule3 = true};
  constexpr Rules kBlocks{.blocks = true};
  struct Wanted {
    FlagMode flags;
    Rules rules;
  };
  std::vector<OurColumn> columns;
  for (const Wanted& w : {Wanted{FlagMode::kOff, kAll}, Wanted{FlagMode::kScene, kAll}, Wanted{FlagMode::kAuto, kAll},
                          Wanted{FlagMode::kOff, kNone}, Wanted{FlagMode::kAuto, kNone},
                          Wanted{FlagMode::kAuto, kBlocks}}) {
    const ReportCase* found = find_case(scene.cases, w.flags, w.rules);
    if (found == nullptr) continue;
    const std::string flags(flags_text(w.flags)), rules = rules_text(w.rules);
    columns.push_back({flags + "_" + rules, "ours, flags " + flags + ", rules " + rules,
                       &scene.results[found->number - 1]});
  }
  return columns;
}

/// Builds the rows; every cell that nobody knows stays empty.
class PaperTable {
 public:
  explicit PaperTable(const SceneResults& scene)
      : paper_(paper_room(scene.name)), seconds_(scene.workstation), ours_(our_columns(scene)) {
    table_.file = "paper.csv";
    table_.scene = scene.name;
    table_.columns = {{"quantity", "", true},
                      {"paper_without_flags", "paper, without flags"},
                      {"paper_with_flags", "paper, with flags"}};
    for (const OurColumn& column : ours_) table_.columns.push_back({column.name, column.title});
    table_.columns.push_back({"workstation", "ours, workstation"});
  }

  Table build() {
    const auto paper = [&](auto value) { return paper_ == nullptr ? Cell{} : value(*paper_); };
    const auto none = [](const Statistics&) { return Cell{}; };
    both("patches", paper([](const PaperRoom& p) { return Cell::number(p.patches); }),
         [](const Statistics& s) { return Cell::number(s.patches); });
    both("sub-patches", paper([](const PaperRoom& p) { return Cell::number(p.sub_patches); }),
         [](const Statistics& s) { return Cell::number(s.sub_patches); });
    row("direct light, seconds", paper([](const PaperRoom& p) { return Cell::real(p.without.direct); }),
        paper([](const PaperRoom& p) { return Cell::real(p.with.direct); }), none, &WorkstationSeconds::direct);
    ours("direct light, segments", [](const Statistics& s) { return Cell::count(s.segments_direct); });
    ours("direct light, triangle tests", [](const Statistics& s) { return Cell::count(s.tests_direct); });
    row("form factors, seconds", paper([](const PaperRoom& p) { return Cell::real(p.without.form_factors); }),
        paper([](const PaperRoom& p) { return Cell::real(p.with.form_factors); }), none,
        &WorkstationSeconds::form_factors);
    ours("form factors, computed", [](const Statistics& s) { return Cell::number(s.form_factors_computed); });
    ours("form factors, segments", [](const Statistics& s) { return Cell::count(s.segments_ambient); });
    ours("form factors, triangle tests", [](const Statistics& s) { return Cell::count(s.tests_ambient); });
    row("non-zeros", paper([](const PaperRoom& p) { return Cell::number(p.without.nonzeros); }),
        paper([](const PaperRoom& p) { return Cell::number(p.with.nonzeros); }),
        [](const Statistics& s) { return Cell::number(s.nonzeros); }, nullptr);
    ours("rows, bytes", [](const Statistics& s) { return Cell::bytes(s.row_bytes); });
    row("solution, seconds", paper([](const PaperRoom& p) { return Cell::real(p.without.solution); }),
        paper([](const PaperRoom& p) { return Cell::real(p.with.solution); }), none, &WorkstationSeconds::solution);
    ours("solution, sweeps", [](const Statistics& s) { return Cell::number(s.sweeps); });
    row("maps, seconds", {}, {}, none, &WorkstationSeconds::map);
    both("picture, seconds", paper([](const PaperRoom& p) { return Cell::real(p.picture); }), none);
    if (seconds_) table_.rows.back().back() = Cell::real(seconds_->picture);
    row("total, seconds", {}, paper([](const PaperRoom& p) { return Cell::real(p.total); }), none,
        &WorkstationSeconds::total);
    ours("memory, peak", [](const Statistics& s) { return Cell::bytes(s.memory_peak); });
    error_row();
    std::erase_if(table_.rows, [](const std::vector<Cell>& row) {
      return std::all_of(row.begin() + 1, row.end(), [](const Cell& c) { return c.kind == CellKind::kEmpty; });
    });
    return table_;
  }

 private:
  using OfStatistics = Cell (*)(const Statistics&);

  void row(const char* title, Cell without, Cell with, OfStatistics of, double WorkstationSeconds::*seconds) {
    std::vector<Cell> cells{Cell::words(title), std::move(without), std::move(with)};
    for (const OurColumn& column : ours_) cells.push_back(of(column.result->statistics));
    cells.push_back(seconds != nullptr && seconds_ ? Cell::real((*seconds_).*seconds) : Cell{});
    table_.rows.push_back(std::move(cells));
  }
  void both(const char* title, const Cell& paper, OfStatistics of) { row(title, paper, paper, of, nullptr); }
  void ours(const char* title, OfStatistics of) { row(title, {}, {}, of, nullptr); }

  void error_row() {
    ours("error of the ambient maps", [](const Statistics&) { return Cell{}; });
    for (std::size_t k = 0; k < ours_.size(); ++k)
      table_.rows.back()[k + 3] = Cell::percent(ours_[k].result->map.ambient);
  }

  const PaperRoom* paper_;
  const std::optional<WorkstationSeconds>& seconds_;
  std::vector<OurColumn> ours_;
  Table table_;
};

std::string yes_or_no(bool value) { return value ? "yes" : "no"; }

Cell ratio(std::uint64_t a, std::uint64_t b) {
  return b == 0 ? Cell{} : Cell::real(static_cast<double>(a) / static_cast<double>(b));
}

}  // namespace

Table paper_table(const SceneResults& scene) { return PaperTable(scene).build(); }

Table flags_table(const SceneResults& scene) {
  Table table{"flags.csv", scene.name, {}, {}, {}};
  table.columns = {{"rules", "rules", true},
                   {"maps_identical", "maps identical", true},
                   {"picture_identical", "picture identical", true},
                   {"direct_tests_ratio", "direct light, tests: off / auto"},
                   {"direct_segments_ratio", "direct light, segments: off / auto"},
                   {"form_factor_tests_ratio", "form factors, tests: off / auto"},
                   {"form_factor_segments_ratio", "form factors, segments: off / auto"}};
  for (const FlagsProof& proof : scene.proofs) {
    const Statistics &off = scene.results[proof.off].statistics, &on = scene.results[proof.automatic].statistics;
    table.rows.push_back({Cell::words(rules_text(scene.cases[proof.off].options.rules)),
                          Cell::words(yes_or_no(proof.same_maps)), Cell::words(yes_or_no(proof.same_picture)),
                          ratio(off.tests_direct, on.tests_direct), ratio(off.segments_direct, on.segments_direct),
                          ratio(off.tests_ambient, on.tests_ambient),
                          ratio(off.segments_ambient, on.segments_ambient)});
  }
  return table;
}

}  // namespace shodo

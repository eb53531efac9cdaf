// report: runs many cases of each scene and tells what they cost and how wrong they are (contract 1). The paper's point
// is speed; ours is speed against error.
//
// Every scene is loaded once before anything is computed, so that a mistake in the last one is told at once. The folder
// is tried first and gets its name at the end, as the maps' does.
#include <algorithm>
#include <string>

#include "cli/commands.h"
#include "cli/output.h"
#include "cli/report_memory.h"
#include "cli/report_results.h"
#include "cli/report_scaling.h"
#include "cli/run.h"

namespace shodo {

namespace {

/// "day" of "data/day.scn".
std::string stem(const std::string& path) {
  std::string name = path.substr(path.rfind('/') + 1);
  const std::size_t dot = name.rfind('.');
  return dot == std::string::npos || dot == 0 ? name : name.substr(0, dot);
}

/// Two scenes of one name are told apart by their paths.
std::string name_of(const std::string& scene, const std::vector<std::string>& scenes) {
  const auto same = [&](const std::string& other) { return stem(other) == stem(scene); };
  return std::count_if(scenes.begin(), scenes.end(), same) > 1 ? scene : stem(scene);
}

/// A file beside the report that a target of make leaves there.
struct BesideFile {
  std::string path, target;
  std::string text;  // empty if there is none
};

BesideFile file_beside(std::string folder, const std::string& name, const std::string& target) {
  while (folder.size() > 1 && folder.back() == '/') folder.pop_back();
  const std::size_t slash = folder.rfind('/');
  const std::string path = (slash == std::string::npos ? "" : folder.substr(0, slash + 1)) + name;
  SceneFiles file(path);
  std::string_view text;
  FileError error;
  return {path, target, file.read_top(text, error) ? std::string(text) : ""};
}

void warn_unless(bool understood, const BesideFile& file, Run& run) {
  if (!understood) run.warn(file.path + ": not as make " + file.target + " leaves it, so it is left out");
}

/// One scene's runs: the reference first, then the cases in their order.
std::vector<ReportJob> jobs_of(const Arguments& arguments, const std::string& scene,
                               const std::vector<ReportCase>& cases) {
  const auto job = [&](const Options& options, const std::string& what, bool takes_more) {
    ReportJob made;
    made.scene = scene;
    made.label = stem(scene) + ", " + what;
    made.options = options;
    made.options.effects = false;  // pictures are compared for their light
    made.memory = arguments.memory;
    made.takes_more = takes_more;
    return made;
  };
  std::vector<ReportJob> jobs{job(reference_options(arguments.options), "reference", true)};
  for (const ReportCase& c : cases)
    jobs.push_back(job(c.options, "case " + std::to_string(c.number), c.refine > 1 || c.options.row_value_bits > 16));
  return jobs;
}

/// Whether the scene loads and has the camera; the exit status. `mirrors` becomes true if it has any.
int check_scene(const Arguments& arguments, const std::string& scene, bool& mirrors) {
  Arguments one = arguments;
  one.scene = scene;
  Run run(one);
  if (const int status = run.load_at_any_size(); status != 0) return status;
  if (const int status = run.find_camera(); status != 0) return status;
  run.warn_of_changes();
  for (const Optics& optics : run.model().scene.optics) mirrors = mirrors || optics.mirrors();
  return 0;
}

/// Whether every run fits into the budget, before minutes are spent; the exit status.
int check_budget(const std::vector<std::vector<ReportJob>>& scenes, Run& run) {
  std::uint64_t needed = 0;
  for (const std::vector<ReportJob>& jobs : scenes) {
    for (const ReportJob& job : jobs) {
      std::uint64_t bytes = 0;
      if (const Status status = smallest_budget(job, bytes); !status.done()) return run.tell(status);
      needed = std::max(needed, bytes);
      if (const int status = run.tell_interrupt(); status != 0) return status;
    }
  }
  return needed > run.arguments().memory ? run.refuse_budget(needed) : 0;
}

bool write_report(const Document& document, OutputFolder& folder, FileError& error) {
  if (!folder.open(error) || !folder.write_file("index.html", html_text(document), error) ||
      !folder.write_file("report.md", markdown_text(document), error))
    return false;
  for (const auto& files : {csv_files(document), plot_files(document)}) {
    for (const NamedText& file : files) {
      if (!folder.write_file(file.name, file.text, error)) return false;
    }
  }
  return true;
}

/// All scenes' runs share the cores; the longest are begun first so that none is waited for at the end.
Status run_all(std::vector<std::vector<ReportJob>>& scenes, bool shown) {
  std::vector<ReportJob> all;
  std::vector<std::pair<std::size_t, std::size_t>> from;
  const auto is_long = [](const ReportJob& job, std::size_t k) {
    return k == 0 || job.options.flags == FlagMode::kOff;
  };
  for (const bool wanted : {true, false}) {
    for (std::size_t s = 0; s < scenes.size(); ++s) {
      for (std::size_t k = 0; k < scenes[s].size(); ++k) {
        if (is_long(scenes[s][k], k) != wanted) continue;
        all.push_back(scenes[s][k]);
        from.emplace_back(s, k);
      }
    }
  }
  const Status status = run_jobs(all, shown);
  for (std::size_t k = 0; k < all.size(); ++k) scenes[from[k].first][from[k].second] = std::move(all[k]);
  return status;
}

}  // namespace

int report(const Arguments& arguments) {
  Run run(arguments);  // tells what goes wrong
  FileError error;
  OutputFolder folder(arguments.output);
  if (!folder.probe(error)) return run.tell(error);
  bool mirrors = false;
  for (const std::string& scene : arguments.scenes) {
    if (const int status = check_scene(arguments, scene, mirrors); status != 0) return status;
  }
  const std::vector<ReportCase> cases = report_cases(arguments.options, mirrors);
  std::vector<std::vector<ReportJob>> jobs;
  for (const std::string& scene : arguments.scenes) jobs.push_back(jobs_of(arguments, scene, cases));
  if (const int status = check_budget(jobs, run); status != 0) return status;
  if (const Status status = run_all(jobs, run.watch().shown()); !status.done()) return run.tell(status);
  const BesideFile seconds = file_beside(arguments.output, "workstation.json", "workstation");
  const BesideFile counted = file_beside(arguments.output, "case-cost.csv", "case-cost");
  const BesideFile memory = file_beside(arguments.output, "memory-cost.csv", "memory-cost");
  CaseCosts costs;
  warn_unless(costs.read(counted.text), counted, run);
  std::vector<MemoryCost> memory_cost;
  warn_unless(memory_costs(memory.text, memory_cost), memory, run);
  const BesideFile scaling = file_beside(arguments.output, "scaling.csv", "scaling");
  std::vector<CountedLine> sizes;
  warn_unless(read_scaling(scaling.text, sizes), scaling, run);
  std::vector<SceneResults> results;
  bool understood = true;
  for (std::size_t s = 0; s < jobs.size(); ++s) {
    const std::string name = name_of(arguments.scenes[s], arguments.scenes);
    results.push_back(evaluate(name, cases, jobs[s], costs));
    understood = workstation_seconds(seconds.text, name, results.back().workstation) && understood;
  }
  warn_unless(understood, seconds, run);
  for (SceneResults& result : results) {
    if (!understood) result.workstation.reset();
  }
  Document document = report_document(results);
  add_scaling_chapter(document, sizes);
  add_memory_chapter(document, memory_cost);
  if (!write_report(document, folder, error)) return run.tell(error);
  if (const int status = run.tell_interrupt(); status != 0) return status;
  return folder.commit(error) ? 0 : run.tell(error);
}

}  // namespace shodo

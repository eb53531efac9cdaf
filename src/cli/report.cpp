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

/// A file beside the report; empty if there is none.
std::string file_beside(std::string folder, const std::string& name) {
  while (folder.size() > 1 && folder.back() == '/') folder.pop_back();
  const std::size_t slash = folder.rfind('/');
  SceneFiles file((slash == std::string::npos ? "" : folder.substr(0, slash + 1)) + name);
  std::string_view text;
  FileError error;
  return file.read_top(text, error) ? std::string(text) : "";
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

/// Whether the scene loads, fits into the budget and has the camera; the exit status. `mirrors` becomes true if it has
/// any.
int check_scene(const Arguments& arguments, const std::string& scene, bool& mirrors) {
  Arguments one = arguments;
  one.scene = scene;
  Run run(one);
  if (const int status = run.load_in_budget(); status != 0) return status;
  if (const int status = run.find_camera(); status != 0) return status;
  run.warn_of_changes();
  for (const Optics& optics : run.model().scene.optics) mirrors = mirrors || optics.mirrors();
  return 0;
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
  if (const Status status = run_all(jobs, run.watch().shown()); !status.done()) return run.tell(status);
  const std::string json = file_beside(arguments.output, "workstation.json");
  std::vector<SceneResults> results;
  for (std::size_t s = 0; s < jobs.size(); ++s) {
    results.push_back(evaluate(name_of(arguments.scenes[s], arguments.scenes), cases, jobs[s]));
    results.back().workstation = workstation_seconds(json, stem(arguments.scenes[s]));
  }
  Document document = report_document(results, workstation_options(json));
  add_memory_chapter(document, memory_costs(file_beside(arguments.output, "memory-cost.csv")));
  if (!write_report(document, folder, error)) return run.tell(error);
  if (const int status = run.tell_interrupt(); status != 0) return status;
  return folder.commit(error) ? 0 : run.tell(error);
}

}  // namespace shodo

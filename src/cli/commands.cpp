// render and map: load, light directly, light ambiently, map, draw, write.
//
// Outputs are tried before anything is computed, written under temporary names when all is computed, and get their
// names together at the end, so that a run which fails or is interrupted leaves nothing.
#include "cli/commands.h"

#include "cli/map_files.h"
#include "cli/picture_file.h"
#include "cli/run.h"
#include "cli/statistics_file.h"
#include "cli/table.h"

namespace shodo {

namespace {

/// The tables beside the main output.
class Tables {
 public:
  explicit Tables(const Arguments& arguments) : csv_(arguments.csv), statistics_(arguments.statistics) {}

  bool probe(FileError& error) {
    return (!has_csv() || csv_.probe(error)) && (!has_statistics() || statistics_.probe(error));
  }

  /// Standard output comes last: what is there can't be taken back.
  bool write(Run& run, FileError& error) {
    if (csv_.name() == "-") return write_statistics(run, error) && write_csv(run, error);
    return write_csv(run, error) && write_statistics(run, error);
  }

  bool commit(FileError& error) { return csv_.commit(error) && statistics_.commit(error); }

 private:
  bool has_csv() const { return !csv_.name().empty(); }
  bool has_statistics() const { return !statistics_.name().empty(); }

  bool write_csv(Run& run, FileError& error) {
    return !has_csv() || (csv_.open(error) && write_table(run.model(), csv_, error) && csv_.close(error));
  }

  bool write_statistics(Run& run, FileError& error) {
    if (!has_statistics()) return true;
    const std::string text = statistics_json(run.model(), run.arguments().scene, run.watch());
    return statistics_.open(error) && statistics_.write(text, error) && statistics_.close(error);
  }

  OutputFile csv_, statistics_;
};

/// After something returned false: a file's fault, or the user's wish.
int tell_why(Run& run, const FileError& error) {
  if (!error.text.empty()) return run.tell(error);
  Status status;
  status.code = StatusCode::kInterrupted;
  return run.tell(status);
}

/// The last moment to stop: from here on files get their names.
template <class Output>
int finish(Run& run, Output& output, Tables& tables) {
  FileError error;
  if (!tables.write(run, error) || interrupt_asked()) return tell_why(run, error);
  if (!output.commit(error) || !tables.commit(error)) return run.tell(error);
  run.warn_of_changes();
  return 0;
}

}  // namespace

int render(const Arguments& arguments) {
  Run run(arguments);
  FileError error;
  PictureFile picture(arguments.output, arguments.options.width, arguments.options.height);
  Tables tables(arguments);
  if (!picture.probe(error) || !tables.probe(error)) return run.tell(error);
  if (const int status = run.load_in_budget(); status != 0) return status;
  if (const int status = run.find_camera(); status != 0) return status;
  if (const int status = run.solve(); status != 0) return status;
  if (!picture.open(error)) return run.tell(error);
  if (const int status = run.draw(picture.sink(error), error); status != 0) return status;
  if (!picture.close(error)) return run.tell(error);
  return finish(run, picture, tables);
}

int map(const Arguments& arguments) {
  Run run(arguments);
  FileError error;
  OutputFolder folder(arguments.output);
  Tables tables(arguments);
  if (!folder.probe(error) || !tables.probe(error)) return run.tell(error);
  if (const int status = run.load_in_budget(); status != 0) return status;
  if (const int status = run.solve(); status != 0) return status;
  if (!folder.open(error) || !write_maps(run.model(), folder, error)) return tell_why(run, error);
  return finish(run, folder, tables);
}

}  // namespace shodo

// render and map: load, light directly, light ambiently, map, draw, write.
//
// Outputs are tried before anything is computed, written under temporary names when all is computed, and get their
// names together at the end, so that a run which fails or is interrupted leaves nothing.
#include "cli/commands.h"

#include <algorithm>

#include "cli/map_files.h"
#include "cli/measured_picture.h"
#include "cli/picture_file.h"
#include "cli/run.h"
#include "cli/statistics_file.h"
#include "cli/summary.h"
#include "cli/table.h"

namespace shodo {

namespace {

/// The tables beside the main output; one without a name is not asked for.
class Tables {
 public:
  explicit Tables(const Arguments& a) : file_{OutputFile(a.csv), OutputFile(a.statistics), OutputFile(a.summary)} {}

  bool probe(FileError& error) {
    for (OutputFile& file : file_) {
      if (!file.name().empty() && !file.probe(error)) return false;
    }
    return true;
  }

  /// Standard output comes last: what is there can't be taken back.
  bool write(Run& run, FileError& error) {
    for (const bool last : {false, true}) {
      for (std::size_t k = 0; k < 3; ++k) {
        OutputFile& file = file_[k];
        if (file.name().empty() || (file.name() == "-") != last) continue;
        if (!file.open(error) || !write(k, run, file, error) || !file.close(error)) return false;
      }
    }
    return true;
  }

  bool commit(FileError& error) { return file_[0].commit(error) && file_[1].commit(error) && file_[2].commit(error); }

 private:
  static bool write(std::size_t table, Run& run, OutputFile& file, FileError& error) {
    if (table == 0) return write_table(run.model(), file, error);
    if (table == 2) return file.write(summary_table(run.model()), error);
    return file.write(statistics_json(run), error);
  }

  OutputFile file_[3];
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

/// The canvas gets the picture's lines; its rows must be there.
LineSink canvas_sink(Canvas& canvas) {
  return {[](void* to, std::uint32_t y, std::span<const std::uint8_t> rgb) {
            Canvas& c = *static_cast<Canvas*>(to);
            std::copy(rgb.begin(), rgb.end(), c.rgb.begin() + std::ptrdiff_t{3} * c.width * y);
            return true;
          },
          &canvas};
}

/// The picture that measures, into the file.
int draw_measured(Run& run, const LineSink& lines, FileError& error) {
  const Arguments& a = run.arguments();
  Canvas canvas{a.options.width, a.options.height, {}};
  canvas.rgb.resize(std::size_t{3} * canvas.width * canvas.height);
  MeasuredPicture picture(run.model(), a.measured);
  if (!a.measured.false_colour) {
    if (const int status = run.draw(canvas_sink(canvas), error); status != 0) return status;
  }
  if (const int status = run.see(picture.sink()); status != 0) return status;
  picture.finish(canvas);
  const std::size_t line = std::size_t{3} * canvas.width;
  for (std::uint32_t y = 0; y < canvas.height; ++y) {
    const std::span<const std::uint8_t> rgb(&canvas.rgb[y * line], line);
    if (!lines.line(lines.context, y, rgb)) return tell_why(run, error);
  }
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
  const LineSink lines = picture.sink(error);
  const int drawn = arguments.measured.any() ? draw_measured(run, lines, error) : run.draw(lines, error);
  if (drawn != 0) return drawn;
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

// Every call to the system failing in turn: the documented exit status, a message, no partial file, no leak.
#include <gtest/gtest.h>
#include <signal.h>

#include <cerrno>
#include <chrono>
#include <thread>

#include "faults/watched_run.h"

namespace shodo {
namespace {

using Words = Running::Words;

struct Command {
  std::string name;
  Words words;
};

std::vector<Command> commands() {
  const std::string box = test_scene("box.scn"), shapes = test_scene("shapes.scn");
  const Words size{"--size", "24x18", "--segments", "1,1"};
  std::vector<Command> all = {
      {"render to PPM with tables", {"render", box, "-o", "x.ppm", "--csv", "x.csv", "--stats", "x.json"}},
      {"render to PNG", {"render", box, "-o", "x.png"}},
      {"map", {"map", shapes, "-o", "maps", "--segments", "1,1", "--csv", "x.csv"}},
      {"check", {"check", shapes}},
      {"report", {"report", test_scene("sun.scn"), "-o", "report", "--size", "8x6", "--segments", "1,1"}}};
  for (std::size_t k = 0; k < 2; ++k) all[k].words.insert(all[k].words.end(), size.begin(), size.end());
  return all;
}

/// Everything in a folder and in the folders in it, by name; times in statistics left out.
std::map<std::string, std::string> contents(const TestFolder& folder, const std::string& below = "") {
  std::map<std::string, std::string> files;
  for (const std::string& name : folder.entries(below)) {
    const std::string path = below + name;
    struct stat found {};
    if (stat((folder / path).c_str(), &found) == 0 && S_ISDIR(found.st_mode)) {
      files[path + "/"] = "";
      files.merge(contents(folder, path + "/"));
      continue;
    }
    std::string text = file_text(folder / path);
    if (const std::size_t at = text.find("\"seconds\""); at != std::string::npos) text.resize(at);
    files[path] = text;
  }
  return files;
}

/// How a command ends when nothing fails.
struct Usual {
  explicit Usual(const Command& command) {
    const TestFolder folder;
    outcome = watched_run(command.words, folder.path());
    files = contents(folder);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.seen["descriptors"], 0);
    EXPECT_EQ(outcome.seen["maps"], 0);
  }
  WatchedOutcome outcome;
  std::map<std::string, std::string> files;
};

/// One run with a fault. Whatever stands in the folder afterwards is whole; with status 0 it is everything.
int run_with(const Command& command, const std::string& fault, const Usual& usual) {
  SCOPED_TRACE(command.name + " with " + fault);
  const TestFolder folder;
  const WatchedOutcome outcome = watched_run(command.words, folder.path(), fault);
  const std::map<std::string, std::string> files = contents(folder);
  if (outcome.status == 0) {
    EXPECT_EQ(files, usual.files);
    EXPECT_EQ(outcome.out, usual.outcome.out);
  } else {
    EXPECT_TRUE(outcome.status == 1 || outcome.status == 130) << outcome.status;
    EXPECT_EQ(lines_of(outcome.err).size(), 1u) << outcome.err;
    for (const auto& [name, text] : files) {
      EXPECT_TRUE(usual.files.contains(name) && usual.files.at(name) == text) << name << " is partial";
    }
    EXPECT_TRUE(files.empty() || fault.rfind("rename", 0) == 0) << files.begin()->first;
  }
  EXPECT_TRUE(outcome.gave_all_back(usual.outcome))
      << outcome.seen.at("blocks") << " blocks, " << outcome.seen.at("descriptors") << " descriptors, "
      << outcome.seen.at("maps") << " maps";
  return outcome.status;
}

/// A report reads and closes its scene once a case: some of many calls stand for all.
long step_of(const Command& command, long calls) { return command.name == "report" && calls > 16 ? calls / 6 : 1; }

struct Fault {
  std::string call;
  std::string what;
};

TEST(IoFaults, EveryCallThatFailsEndsTheRunWithStatus1AndLeavesNothing) {
  const Fault faults[] = {{"read", std::to_string(EIO)},    {"write", std::to_string(EIO)},
                          {"write", std::to_string(ENOSPC)}, {"write", std::to_string(EPIPE)},
                          {"rename", std::to_string(EACCES)}, {"mkostemp", std::to_string(EMFILE)},
                          {"mkdtemp", std::to_string(EACCES)}, {"chmod", std::to_string(EPERM)},
                          {"mmap", std::to_string(ENOMEM)}};
  for (const Command& command : commands()) {
    Usual usual(command);
    for (const Fault& fault : faults) {
      const long calls = usual.outcome.seen[fault.call];
      for (long k = 1; k <= calls; k += step_of(command, calls)) {
        for (const char* on : {":", "-:"}) {
          const std::string text = fault.call + ":" + std::to_string(k) + on + fault.what;
          EXPECT_EQ(run_with(command, text, usual), 1) << command.name << ", " << text;
        }
      }
    }
  }
}

/// A close that fails loses data only of a file that was written; an open may be one that was only tried.
TEST(IoFaults, AFailedCloseOrOpenIsStatus1OrDidNoHarm) {
  for (const Command& command : commands()) {
    Usual usual(command);
    for (const std::string call : {"close", "open", "opendir"}) {
      long failed = 0;
      const long calls = usual.outcome.seen[call];
      for (long k = 1; k <= calls; k += step_of(command, calls)) {
        const std::string fault = call + ":" + std::to_string(k) + ":" + std::to_string(EIO);
        failed += run_with(command, fault, usual) == 0 ? 0 : 1;
      }
      if (usual.outcome.seen[call] > 0 && call != "opendir" && command.name != "check") {
        EXPECT_GT(failed, 0) << command.name << ", " << call;
      }
    }
  }
}

TEST(IoFaults, ShortReadsAndWritesAndInterruptedCallsChangeNothing) {
  for (const Command& command : commands()) {
    Usual usual(command);
    for (const std::string call : {"read", "write"}) {
      EXPECT_EQ(run_with(command, call + ":1-:short", usual), 0);
      const long calls = usual.outcome.seen[call];
      for (long k = 1; k <= calls; k += step_of(command, calls)) {
        EXPECT_EQ(run_with(command, call + ":" + std::to_string(k) + ":short", usual), 0);
        EXPECT_EQ(run_with(command, call + ":" + std::to_string(k) + ":" + std::to_string(EINTR), usual), 0);
      }
    }
  }
}

TEST(IoFaults, ASystemWithoutMemoryIsStatus1WhereverItRunsOut) {
  for (const Command& command : commands()) {
    if (command.name == "report") continue;  // on several cores no two runs ask in the same order
    Usual usual(command);
    const long calls = usual.outcome.seen["malloc"];
    // All of the first, then one in 97: the table alone makes over a thousand.
    for (long k = 2; k <= calls; k += k < 60 ? 1 : 97) {
      const int status = run_with(command, "malloc:" + std::to_string(k) + "-:" + std::to_string(ENOMEM), usual);
      EXPECT_EQ(status, 1) << command.name << ", block " << k;
    }
  }
}

TEST(IoFaults, AnInterruptAtAnyCallIsStatus130AndLeavesNothingOrComesTooLate) {
  for (const Command& command : commands()) {
    Usual usual(command);
    long stopped = 0;
    for (const std::string call : {"open", "read", "write", "close", "rename", "mkostemp", "mkdtemp", "chmod"}) {
      const long calls = usual.outcome.seen[call];
      for (long k = 1; k <= calls; k += step_of(command, calls)) {
        const int status = run_with(command, call + ":" + std::to_string(k) + ":interrupt", usual);
        EXPECT_TRUE(status == 130 || (status == 0 && (call != "read" && call != "mkdtemp")))
            << command.name << ", " << call << " " << k;
        stopped += status == 130 ? 1 : 0;
      }
    }
    EXPECT_GT(stopped, 0) << command.name;
  }
}

TEST(IoFaults, AnInterruptAtAnyTimeIsStatus130AndLeavesNothingOrComesTooLate) {
  const Words words{"render", test_scene("shapes.scn"), "-o",      "x.ppm", "--csv", "x.csv",
                    "--size", "320x240",                "--refine", "4"};
  long stopped = 0;
  bool done = false;
  for (int milliseconds = 20; !done && milliseconds < 20000; milliseconds += 20 + milliseconds / 4) {
    const TestFolder folder;
    Running running(words, folder.path());
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
    kill(running.process(), SIGINT);
    const Outcome outcome = running.wait();
    done = outcome.status == 0;
    if (done) break;
    EXPECT_EQ(outcome.status, 130) << outcome.err;
    EXPECT_EQ(outcome.err, "shodo: interrupted, nothing was written\n");
    EXPECT_TRUE(folder.entries().empty());
    ++stopped;
  }
  EXPECT_TRUE(done);
  EXPECT_GT(stopped, 2);
}

}  // namespace
}  // namespace shodo

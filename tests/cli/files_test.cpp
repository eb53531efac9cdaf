// What the program does with files: exit statuses 0, 1, 3, 4 and 130, and outputs that appear whole or not at all.
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/resource.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "cli/program.h"

namespace shodo {
namespace {

using Names = std::vector<std::string>;

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

Running::Words render_sun(const std::string& output, const Running::Words& more = {}) {
  Running::Words words{"render", test_scene("sun.scn"), "-o", output, "--size", "16x12"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

Running::Words map_sun(const std::string& output, const Running::Words& more = {}) {
  Running::Words words{"map", test_scene("sun.scn"), "-o", output};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(Files, ASuccessfulRunSaysNothingAndLeavesItsOutputsOnly) {
  const TestFolder folder;
  const Outcome outcome = run(render_sun("x.png", {"--csv", "x.csv", "--stats", "x.json"}), folder.path());
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.out + outcome.err, "");
  EXPECT_EQ(folder.entries(), (Names{"x.csv", "x.json", "x.png"}));
  EXPECT_EQ(run(map_sun("maps"), folder.path()).status, 0);
  EXPECT_EQ(folder.entries("maps"), (Names{"0000.pfm", "0001.pfm", "index.csv"}));
}

TEST(Files, NewFilesHaveTheUsualPermissionsAndOldOnesKeepTheirs) {
  const TestFolder folder;
  folder.write("old.ppm", "old");
  chmod((folder / "old.ppm").c_str(), 0640);
  const mode_t mask = umask(022);
  EXPECT_EQ(run(render_sun("new.ppm"), folder.path()).status, 0);
  EXPECT_EQ(run(render_sun("old.ppm"), folder.path()).status, 0);
  EXPECT_EQ(run(map_sun("maps"), folder.path()).status, 0);
  umask(mask);
  const auto mode = [&](const std::string& name) {
    struct stat found {};
    stat((folder / name).c_str(), &found);
    return found.st_mode & 07777;
  };
  EXPECT_EQ(mode("new.ppm"), 0644u);
  EXPECT_EQ(mode("old.ppm"), 0640u);
  EXPECT_EQ(mode("maps"), 0755u);
  EXPECT_EQ(mode("maps/0000.pfm"), 0644u);
  EXPECT_EQ(file_text(folder / "old.ppm"), file_text(folder / "new.ppm"));
}

TEST(Files, ASymbolicLinkStaysAndItsFileIsReplaced) {
  const TestFolder folder;
  folder.write("real.ppm", "old");
  ASSERT_EQ(symlink("real.ppm", (folder / "link.ppm").c_str()), 0);
  EXPECT_EQ(run(render_sun("link.ppm"), folder.path()).status, 0);
  struct stat found {};
  lstat((folder / "link.ppm").c_str(), &found);
  EXPECT_TRUE(S_ISLNK(found.st_mode));
  EXPECT_EQ(file_text(folder / "real.ppm").substr(0, 2), "P6");
}

TEST(Files, ALinkThatLeadsNowhereMakesItsFile) {
  const TestFolder folder;
  ASSERT_EQ(symlink("new.ppm", (folder / "link.ppm").c_str()), 0);
  EXPECT_EQ(run(render_sun("link.ppm"), folder.path()).status, 0);
  struct stat found {};
  lstat((folder / "link.ppm").c_str(), &found);
  EXPECT_TRUE(S_ISLNK(found.st_mode));
  EXPECT_EQ(file_text(folder / "new.ppm").substr(0, 2), "P6");
  ASSERT_EQ(symlink("further.ppm", (folder / "middle").c_str()), 0);
  ASSERT_EQ(symlink("middle", (folder / "far.ppm").c_str()), 0);
  EXPECT_EQ(run(render_sun("far.ppm"), folder.path()).status, 0);
  EXPECT_EQ(file_text(folder / "further.ppm").substr(0, 2), "P6");
}

TEST(Files, NamesOfWhatIsOpenAreWrittenIntoAndNeverReplaced) {
  const TestFolder folder;
  const auto shell = [&](const std::string& words) {
    const std::string program = program_path() + " map " + test_scene("sun.scn") + " -o m --quiet ";
    const std::string text = "cd " + folder.path() + " && rm -rf m && (echo before; " + program + words +
                             " || echo refused; echo after) >log 2>&1 7>&1";
    EXPECT_EQ(std::system(text.c_str()), 0);
    return lines_of(file_text(folder / "log"));
  };
  const std::vector<std::string> plain = shell("--summary -");
  ASSERT_GT(plain.size(), 3u);
  EXPECT_EQ(plain.front() + plain.back(), "beforeafter");
  for (const char* name : {"/dev/stdout", "/dev/stderr", "/dev/fd/1", "/dev/fd/7", "/proc/self/fd/1"})
    EXPECT_EQ(shell("--summary " + std::string(name)), plain) << name;
  EXPECT_EQ(shell("--summary /dev/stdout --csv -").size(), shell("--csv -").size() + plain.size() - 2) << "both";
  ASSERT_EQ(symlink("/dev/stdout", (folder / "standard").c_str()), 0);
  for (const char* name : {"standard", "/dev//stdout", "log"})
    EXPECT_EQ(shell("--summary " + std::string(name)), plain) << name << ", which is where standard output goes";
  folder.write("own.scn", file_text(test_scene("sun.scn")));
  const std::string before = file_text(folder / "own.scn");
  const std::string onto = program_path() + " map own.scn -o n --csv - >>own.scn 2>said";
  EXPECT_NE(std::system(("cd " + folder.path() + " && " + onto).c_str()), 0);
  EXPECT_EQ(file_text(folder / "own.scn"), before);
  EXPECT_TRUE(contains(shell("--summary /dev/fd/9")[1], "/dev/fd/9: Bad file descriptor"));
  const std::vector<std::string> twice = shell("--csv - --summary log");
  EXPECT_TRUE(contains(twice[1], "two outputs are one file, found 'log'")) << twice[1];
}

TEST(Files, ASceneThatIsNotThereIsStatus1) {
  const TestFolder folder;
  for (const Running::Words& words :
       {Running::Words{"render", "none.scn", "-o", "x.ppm"}, Running::Words{"map", "none.scn", "-o", "m"},
        Running::Words{"check", "none.scn"}}) {
    const Outcome outcome = run(words, folder.path());
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(contains(outcome.err, "none.scn: No such file")) << outcome.err;
  }
  EXPECT_EQ(run({"check", folder.path()}).status, 1) << "a folder";
  EXPECT_TRUE(folder.entries().empty());
}

TEST(Files, ASceneThatIsTooLargeToBeOneIsStatus1) {
  const Outcome outcome = run({"check", "/dev/zero"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_TRUE(contains(outcome.err, "File too large")) << outcome.err;
}

TEST(Files, AWrongSceneIsStatus3WithItsPlace) {
  const TestFolder folder;
  folder.write("wrong.scn", "shodo 1\nunit m\nmaterial grey diffuse x\n");
  for (const Running::Words& words :
       {Running::Words{"check", "wrong.scn"}, Running::Words{"render", "wrong.scn", "-o", "x.ppm"},
        Running::Words{"map", "wrong.scn", "-o", "m"},
        Running::Words{"render", "wrong.scn", "-o", "x.ppm", "--memory", "1"}}) {
    const Outcome outcome = run(words, folder.path());
    EXPECT_EQ(outcome.status, 3);
    EXPECT_EQ(outcome.err.rfind("wrong.scn:3:23: expected", 0), 0u) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, ", found")) << outcome.err;
  }
  EXPECT_EQ(folder.entries(), Names{"wrong.scn"});
}

TEST(Files, AnIncludedFileIsSoughtInTheTopFilesFolder) {
  const TestFolder folder;
  ASSERT_EQ(mkdir((folder / "scenes").c_str(), 0777), 0);
  folder.write("scenes/top.scn", "shodo 1\nunit m\ninclude part.scn\n");
  EXPECT_NE(run({"check", "scenes/top.scn"}, folder.path()).status, 0);
  folder.write("scenes/part.scn",
               file_text(test_scene("sun.scn")).substr(file_text(test_scene("sun.scn")).find("display")));
  const Outcome outcome = run({"check", "scenes/top.scn"}, folder.path());
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

TEST(Files, AMistakeInAnIncludedFileIsNamedByAPathThatIsThere) {
  const TestFolder folder;
  for (const char* name : {"scenes", "scenes/parts"}) ASSERT_EQ(mkdir((folder / name).c_str(), 0777), 0);
  folder.write("scenes/top.scn", "shodo 1\ninclude parts/part.scn\n");
  folder.write("scenes/parts/part.scn", "# a part\nquad\n");
  EXPECT_TRUE(run({"check", "scenes/top.scn"}, folder.path()).err.starts_with("scenes/parts/part.scn:2:"));
  EXPECT_TRUE(run({"check", "top.scn"}, folder / "scenes").err.starts_with("parts/part.scn:2:"));
  folder.write("scenes/top.scn", "shodo 1\nquad\n");
  EXPECT_TRUE(run({"check", "scenes/top.scn"}, folder.path()).err.starts_with("scenes/top.scn:2:"));
  folder.write("scenes/top.scn", "shodo 1\ninclude scenes\n");  // its name begins the top file's path
  folder.write("scenes/scenes", "quad\n");
  EXPECT_TRUE(run({"check", "scenes/top.scn"}, folder.path()).err.starts_with("scenes/scenes:1:"));
  const std::string box = test_scene("box.scn");
  EXPECT_TRUE(run({"report", box, "scenes/top.scn", "-o", "r"}, folder.path()).err.starts_with("scenes/scenes:1:"));
}

TEST(Files, OutputsThatCannotBeWrittenAreRefusedBeforeTheSceneIsRead) {
  const TestFolder folder;
  folder.write("file", "");
  folder.write("wrong.scn", "not a scene");
  ASSERT_EQ(mkdir((folder / "full").c_str(), 0777), 0);
  folder.write("full/thing", "");
  const Running::Words commands[] = {{"render", "wrong.scn", "-o", "missing/x.ppm"},
                                     {"render", "wrong.scn", "-o", "file/x.ppm"},
                                     {"render", "wrong.scn", "-o", "x.ppm", "--csv", "missing/x.csv"},
                                     {"render", "wrong.scn", "-o", "x.ppm", "--stats", "full"},
                                     {"map", "wrong.scn", "-o", "missing/maps"},
                                     {"map", "wrong.scn", "-o", "full"},
                                     {"map", "wrong.scn", "-o", "file"},
                                     {"map", "wrong.scn", "-o", "nowhere"},
                                     {"map", "wrong.scn", "-o", std::string(256, 'm')},
                                     {"render", "wrong.scn", "-o", std::string(252, 'x') + ".ppm"},
                                     {"map", "wrong.scn", "-o", "."}};
  ASSERT_EQ(symlink("none", (folder / "nowhere").c_str()), 0);
  for (const Running::Words& words : commands) {
    const Outcome outcome = run(words, folder.path());
    EXPECT_EQ(outcome.status, 1) << testing::PrintToString(words) << outcome.err;
    EXPECT_EQ(lines_of(outcome.err).size(), 1u);
  }
  EXPECT_EQ(folder.entries(), (Names{"file", "full", "nowhere", "wrong.scn"}));
}

TEST(Files, AFolderWithoutWritePermissionIsStatus1) {
  const TestFolder folder;
  ASSERT_EQ(mkdir((folder / "locked").c_str(), 0777), 0);
  folder.write("sun.scn", file_text(test_scene("sun.scn")));
  folder.write("shodo", file_text(program_path()));
  for (const char* name : {"", "shodo"}) chmod((folder / name).c_str(), 0755);
  chmod((folder / "locked").c_str(), 0555);
  // Root may write everywhere, so the shell gives that up where it has it.
  const std::string as_nobody = geteuid() == 0 ? "setpriv --reuid=65534 --clear-groups " : "";
  for (const std::string words :
       {"render sun.scn -o locked/x.ppm", "map sun.scn -o locked/maps", "render sun.scn -o /dev/null.png"}) {
    const std::string command = "cd " + folder.path() + " && " + as_nobody + "./shodo " + words + " 2>message";
    const int status = std::system(command.c_str());
    EXPECT_EQ(WIFEXITED(status) ? WEXITSTATUS(status) : -1, 1) << words;
    EXPECT_TRUE(contains(file_text(folder / "message"), "Permission denied")) << file_text(folder / "message");
  }
  EXPECT_TRUE(folder.entries("locked").empty());
}

TEST(Files, AFolderThatTheSystemProtectsIsStatus1) {
  if (access("/proc/self/stat", F_OK) != 0) GTEST_SKIP() << "no /proc is mounted here";
  EXPECT_EQ(run(render_sun("/proc/x.ppm")).status, 1);
  EXPECT_EQ(run(map_sun("/proc/maps-of-shodo")).status, 1);
}

TEST(Files, AnEmptyFolderIsFilled) {
  const TestFolder folder;
  ASSERT_EQ(mkdir((folder / "maps").c_str(), 0777), 0);
  EXPECT_EQ(run(map_sun("maps/"), folder.path()).status, 0);
  EXPECT_EQ(folder.entries(), Names{"maps"});
  EXPECT_EQ(folder.entries("maps").size(), 3u);
}

TEST(Files, AFullDeviceIsStatus1AndNoOtherOutputAppears) {
  const TestFolder folder;
  for (const char* option : {"--csv", "--stats"}) {
    const Outcome outcome = run(render_sun("x.ppm", {option, "/dev/full"}), folder.path());
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(outcome.err, "shodo: /dev/full: No space left on device\n");
    EXPECT_EQ(run(map_sun("maps", {option, "/dev/full"}), folder.path()).status, 1);
  }
  EXPECT_TRUE(folder.entries().empty());
  EXPECT_EQ(Running({"--help"}, "", "/dev/full").wait().status, 1);
  EXPECT_EQ(Running({"check", test_scene("sun.scn")}, "", "/dev/full").wait().status, 1);
}

TEST(Files, ADiskThatFillsUpLeavesTheOldFile) {
  const TestFolder folder;
  for (const char* name : {"x.ppm", "x.png"}) {
    folder.write(name, "old");
    Running::Words words = render_sun(name);
    words.insert(words.end(), {"--csv", "x.csv"});
    // A limit on the size of files stands for a full disk.
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit small{100, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    const Outcome outcome = run(words, folder.path());
    setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_EQ(outcome.status, 1) << outcome.err;
    EXPECT_EQ(file_text(folder / name), "old");
  }
  EXPECT_EQ(folder.entries(), (Names{"x.png", "x.ppm"}));
}

TEST(Files, ADeviceStaysADevice) {
  const TestFolder folder;
  EXPECT_EQ(run(render_sun("x.ppm", {"--csv", "/dev/null"}), folder.path()).status, 0);
  struct stat found {};
  ASSERT_EQ(stat("/dev/null", &found), 0);
  EXPECT_TRUE(S_ISCHR(found.st_mode));
}

TEST(Files, AClosedPipeIsStatus1) {
  const TestFolder folder;
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  close(ends[0]);
  const Outcome outcome =
      Running(render_sun("x.ppm", {"--stats", "-"}), folder.path(), "&" + std::to_string(ends[1])).wait();
  close(ends[1]);
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.err, "shodo: standard output: Broken pipe\n");
  EXPECT_TRUE(folder.entries().empty());
}

TEST(Files, AClosedStandardOutputIsStatus1AndClosedErrorDoesNoHarm) {
  const TestFolder folder;
  EXPECT_EQ(Running(render_sun("x.ppm", {"--stats", "-"}), folder.path(), "-").wait().status, 1);
  EXPECT_TRUE(folder.entries().empty());
  EXPECT_EQ(Running(render_sun("x.ppm"), folder.path(), "-", "-").wait().status, 0);
  EXPECT_EQ(file_text(folder / "x.ppm").substr(0, 2), "P6");
}

// --- memory ---

/// The number in "expected at least N bytes".
std::string smallest_named(const std::string& text) {
  const std::string before = "at least ";
  const std::size_t at = text.find(before);
  if (at == std::string::npos) return "";
  return text.substr(at + before.size(), text.find(' ', at + before.size()) - at - before.size());
}

TEST(Memory, ATooSmallBudgetIsStatus4AndNamesTheSmallestThatWorks) {
  for (const std::string name : {"sun.scn", "box.scn", "shapes.scn"}) {
    const TestFolder folder;
    const Running::Words render{"render", test_scene(name), "-o", "x.ppm", "--size", "48x40", "--csv", "x.csv"};
    const Running::Words map{"map", test_scene(name), "-o", "maps"};
    const auto with = [&](Running::Words words, const std::string& memory) {
      words.insert(words.end(), {"--memory", memory});
      return run(words, folder.path());
    };
    const Outcome refused = with(render, "1");
    EXPECT_EQ(refused.status, 4) << refused.err;
    EXPECT_TRUE(folder.entries().empty());
    const std::string smallest = smallest_named(refused.err);
    ASSERT_FALSE(smallest.empty()) << refused.err;
    const std::string less = std::to_string(std::stoull(smallest) - 1);
    const Outcome still = with(render, less);
    EXPECT_EQ(still.status, 4) << name;
    EXPECT_EQ(smallest_named(still.err), smallest);
    EXPECT_TRUE(folder.entries().empty());

    const Outcome tight = with(render, smallest);
    ASSERT_EQ(tight.status, 0) << name << tight.err;
    const std::string picture = file_text(folder / "x.ppm"), table = file_text(folder / "x.csv");
    EXPECT_EQ(with(render, "64M").status, 0);
    EXPECT_TRUE(picture == file_text(folder / "x.ppm")) << name << ": the picture depends on the budget";
    EXPECT_TRUE(table == file_text(folder / "x.csv")) << name << ": the table depends on the budget";

    const std::string smallest_map = smallest_named(with(map, "1").err);
    EXPECT_LE(std::stoull(smallest_map), std::stoull(smallest));
    EXPECT_EQ(with(map, smallest_map).status, 0) << name;
  }
}

TEST(Memory, CheckNamesTheSameSmallestBudget) {
  const TestFolder folder;
  const std::string smallest = smallest_named(run(render_sun("x.ppm", {"--memory", "1"}), folder.path()).err);
  const Outcome check = run({"check", test_scene("sun.scn"), "--size", "16x12"});
  std::string digits;
  const std::size_t at = check.out.find("memory:");
  ASSERT_NE(at, std::string::npos);
  for (const char c : check.out.substr(at, check.out.find(" byte", at) - at)) {
    if (c >= '0' && c <= '9') digits += c;
  }
  EXPECT_EQ(digits, smallest) << check.out;
}

// --- interrupts and progress ---

/// A terminal that the program writes to, as seen from its other side.
class Terminal {
 public:
  Terminal() : master_(posix_openpt(O_RDWR | O_NOCTTY)) {
    if (grantpt(master_) == 0 && unlockpt(master_) == 0) name_ = ptsname(master_);
    keep_ =
        open(name_.c_str(), O_RDWR | O_NOCTTY);  // so that what was written stays readable when the program has ended
  }
  ~Terminal() {
    close(keep_);
    close(master_);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  const std::string& name() const { return name_; }
  bool works() const { return keep_ >= 0; }

  /// Everything written so far, after waiting for more at most so long.
  const std::string& read(int milliseconds) {
    pollfd waiting{master_, POLLIN, 0};
    for (; poll(&waiting, 1, milliseconds) > 0 && (waiting.revents & POLLIN) != 0; milliseconds = 0) {
      char part[4096];
      const ssize_t got = ::read(master_, part, sizeof part);
      if (got <= 0) break;
      text_.append(part, static_cast<std::size_t>(got));
    }
    return text_;
  }

 private:
  int master_, keep_ = -1;
  std::string name_, text_;
};

struct Stop {
  std::string stage;  // as the progress line calls it
  int signal;
  Running::Words words;
};

TEST(Interrupts, ASignalInAnyLongStageEndsTheRunWithStatus130AndLeavesNothing) {
  if (!Terminal().works()) GTEST_SKIP() << "this system gives no pseudo-terminals";
  const std::string shapes = test_scene("shapes.scn"), cornell = source_path("data/cornell.scn");
  // The first stage is shown at once, others ten times a second: these take a second or so.
  const Stop stops[] = {
      {"direct", SIGINT, {"render", shapes, "-o", "x.ppm", "--refine", "12", "--memory", "1G"}},
      {"form factors",
       SIGTERM,
       {"map", shapes, "-o", "maps", "--refine", "3", "--segments", "256,256", "--tiers", "near", "--memory", "64M"}},
      {"picture",
       SIGINT,
       {"render", cornell, "-o", "x.ppm", "--size", "16384x16384", "--antialias", "16", "--csv", "x.csv"}},
      {"picture", SIGTERM, {"render", cornell, "-o", "x.png", "--size", "8192x8192", "--antialias", "16"}},
  };
  for (const Stop& stop : stops) {
    const TestFolder folder;
    Terminal terminal;
    Running running(stop.words, folder.path(), "", terminal.name());
    for (int k = 0; k < 300 && !contains(terminal.read(100), stop.stage); ++k) {
    }
    kill(running.process(), stop.signal);
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(running.wait().status, 130) << stop.stage;
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5)) << "it should stop at once";
    EXPECT_TRUE(contains(terminal.read(0), stop.stage) &&
                contains(terminal.read(0), "shodo: interrupted, nothing was written"))
        << terminal.read(0);
    EXPECT_TRUE(folder.entries().empty()) << stop.stage;
  }
}

/// What a run writes to a terminal.
std::string on_terminal(const Running::Words& words, const std::string& folder) {
  Terminal terminal;
  EXPECT_EQ(Running(words, folder, "", terminal.name()).wait().status, 0);
  return terminal.read(0);
}

TEST(Progress, IsShownOnATerminalOnlyAndNotWhenQuiet) {
  if (!Terminal().works()) GTEST_SKIP() << "this system gives no pseudo-terminals";
  const TestFolder folder;
  const Running::Words words = render_sun("x.ppm");
  const std::string shown = on_terminal(words, folder.path());
  EXPECT_TRUE(contains(shown, " %")) << shown;
  EXPECT_EQ(shown.back(), '\r') << "the line is wiped at the end";
  Running::Words quiet = words;
  quiet.push_back("--quiet");
  EXPECT_EQ(on_terminal(quiet, folder.path()), "");
  EXPECT_EQ(run(words, folder.path()).err, "") << "not a terminal";
}

}  // namespace
}  // namespace shodo

#include <gtest/gtest.h>

#include <filesystem>
#include <ostream>

#include "gvd/io/staged_files.hpp"
#include "support/temporary_directory.hpp"

using namespace gvd;
using Names = std::set<std::string>;
namespace fs = std::filesystem;

namespace {

void say(io::StagedFiles& files, const std::string& name, const std::string& text) {
  files.write(name, [&](std::ostream& out) { out << text; });
}

TEST(StagedFiles, AppearTogetherAtTheCommit) {
  const test::TemporaryDirectory root;
  test::write_file(root / "a", "old");
  io::StagedFiles files(root.path(), {"a", "b"});
  say(files, "a", "new");
  say(files, "b", "b");
  EXPECT_EQ(test::read_file(root / "a"), "old");
  EXPECT_FALSE(fs::exists(root / "b"));
  files.commit();
  EXPECT_EQ(test::read_file(root / "a"), "new");
  EXPECT_EQ(root.names(), (Names{"a", "b"}));
}

TEST(StagedFiles, MakeMissingDirectoriesOnlyWhenNeeded) {
  const test::TemporaryDirectory root;
  {
    io::StagedFiles files(root / "x/y/z/", {"a"});
    EXPECT_EQ(root.names(), Names{});
    say(files, "a", "text");
    files.commit();
  }
  EXPECT_EQ(test::read_file(root / "x/y/z/a"), "text");
}

TEST(StagedFiles, LeaveNothingWithoutACommit) {
  const test::TemporaryDirectory root;
  {
    io::StagedFiles files(root / "x/y", {"a", "b"});
    say(files, "a", "text");
    EXPECT_FALSE(root.names().empty());
  }
  EXPECT_EQ(root.names(), Names{});
}

TEST(StagedFiles, LeaveNothingWhenAWriterThrows) {
  const test::TemporaryDirectory root;
  const auto attempt = [&] {
    io::StagedFiles files(root / "x", {"a", "b"});
    say(files, "a", "text");
    files.write("b", [](std::ostream&) { throw std::runtime_error("broken"); });
  };
  EXPECT_THROW(attempt(), std::runtime_error);
  EXPECT_EQ(root.names(), Names{});
}

TEST(StagedFiles, AFailedStreamIsAnError) {
  const test::TemporaryDirectory root;
  const auto attempt = [&] {
    io::StagedFiles files(root.path(), {"a"});
    files.write("a", [](std::ostream& out) { out.setstate(std::ios::badbit); });
  };
  EXPECT_THROW(attempt(), io::OutputError);
  EXPECT_EQ(root.names(), Names{});
}

TEST(StagedFiles, RefuseWhatCannotBeADirectory) {
  const test::TemporaryDirectory root;
  test::write_file(root / "file", "");
  fs::create_directory(root / "sub");
  EXPECT_THROW(io::StagedFiles(root / "file", {"a"}), io::OutputPathError);
  EXPECT_THROW(io::StagedFiles(root / "file/below/it", {"a"}), io::OutputPathError);
  EXPECT_THROW(io::StagedFiles(root.path(), {"sub"}), io::OutputPathError) << "a target is a directory";
  EXPECT_THROW(io::StagedFiles("/dev", {"null"}), io::OutputPathError) << "renaming would replace a device";
  EXPECT_EQ(root.names(), (Names{"file", "sub"}));
}

TEST(StagedFiles, RefuseADanglingLinkOnTheWay) {
  const test::TemporaryDirectory root;
  fs::create_symlink(root / "nowhere", root / "link");
  EXPECT_THROW(io::StagedFiles(root / "link/x", {"a"}), io::OutputPathError);
}

}  // namespace

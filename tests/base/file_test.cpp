#include "prt/base/file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "prt/base/error.h"

namespace prt {
namespace {

namespace fs = std::filesystem;

/// A folder of its own for each test, removed afterwards.
class FileTest : public testing::Test {
  protected:
    FileTest() {
        std::string name = (fs::temp_directory_path() / "prt-file-test-XXXXXX").string();
        folder_ = ::mkdtemp(name.data());
    }
    ~FileTest() override { fs::remove_all(folder_); }

    fs::path path(const std::string& name) const { return folder_ / name; }

    std::ptrdiff_t entryCount() const {
        return std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
    }

  private:
    fs::path folder_;
};

std::string readText(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void writeText(const fs::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

/// The error that an action throws; fails the test if it throws none.
template <class Action>
Error catchError(const Action& action) {
    try {
        action();
    } catch (const Error& error) {
        return error;
    }
    ADD_FAILURE() << "no Error was thrown";
    return Error(ErrorCode::cancelled, "none");
}

/// Makes every write beyond so many bytes of a file fail, as a full disk would.
class FileSizeLimit {
  public:
    explicit FileSizeLimit(rlim_t maxBytes) : previousHandler_(std::signal(SIGXFSZ, SIG_IGN)) {
        ::getrlimit(RLIMIT_FSIZE, &previousLimit_);
        rlimit limit = previousLimit_;
        limit.rlim_cur = maxBytes;
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;
    ~FileSizeLimit() {
        ::setrlimit(RLIMIT_FSIZE, &previousLimit_);
        std::signal(SIGXFSZ, previousHandler_);
    }

  private:
    void (*previousHandler_)(int);
    rlimit previousLimit_{};
};

TEST_F(FileTest, ReadsAllBytesUpToTheLimit) {
    const std::string text("one\0two\r\n", 9);
    writeText(path("a"), text);

    const std::vector<std::byte> bytes = readFile(path("a"), text.size());

    EXPECT_EQ(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()), text);
}

TEST_F(FileTest, ReadsAnEmptyFileAsNoBytes) {
    writeText(path("empty"), "");

    EXPECT_TRUE(readFile(path("empty"), 0).empty());
}

TEST_F(FileTest, RefusesAFileOverTheLimit) {
    writeText(path("a"), "12345");

    const Error error = catchError([&] { readFile(path("a"), 4); });

    EXPECT_EQ(error.code(), ErrorCode::limitExceeded);
    EXPECT_EQ(error.where(), path("a").string());
    EXPECT_STREQ(error.what(), "has 5 bytes, more than the limit of 4");
}

TEST_F(FileTest, RefusesBeforeItAllocates) {
    // A hole takes no disk; allocating or reading it would take this test down.
    writeText(path("huge"), "");
    fs::resize_file(path("huge"), std::uintmax_t(1) << 42);

    EXPECT_EQ(catchError([&] { readFile(path("huge"), 1 << 20); }).code(),
              ErrorCode::limitExceeded);
}

TEST_F(FileTest, TellsAMissingFileFromAFolder) {
    EXPECT_EQ(catchError([&] { readFile(path("missing"), 10); }).code(), ErrorCode::notFound);
    fs::create_directory(path("folder"));
    const Error error = catchError([&] { readFile(path("folder"), 10); });
    EXPECT_EQ(error.code(), ErrorCode::unreadable);
    EXPECT_STREQ(error.what(), "is not a file");
}

TEST_F(FileTest, WritesNewContentOverOldAndLeavesNothingElse) {
    writeFileAtomically(path("a"), std::string("old content, longer"));
    writeFileAtomically(path("a"), std::string("new"));

    EXPECT_EQ(readText(path("a")), "new");
    EXPECT_EQ(entryCount(), 1);
}

TEST_F(FileTest, GivesTheFileThePermissionsOfAnOrdinaryOne) {
    writeText(path("ordinary"), "");
    writeFileAtomically(path("atomic"), std::string());

    EXPECT_EQ(fs::status(path("atomic")).permissions(), fs::status(path("ordinary")).permissions());
}

TEST_F(FileTest, KeepsTheOldContentWhenTheDiskIsFull) {
    writeText(path("a"), "old");
    const std::vector<std::byte> large(100'000);

    Error error(ErrorCode::cancelled, "");
    {
        const FileSizeLimit limit(65'536);
        error = catchError([&] { writeFileAtomically(path("a"), large); });
    }

    EXPECT_EQ(error.code(), ErrorCode::writeFailed);
    EXPECT_EQ(error.where(), path("a").string());
    EXPECT_STREQ(error.what(), "cannot be written: File too large");
    EXPECT_EQ(readText(path("a")), "old");
    EXPECT_EQ(entryCount(), 1);
}

TEST_F(FileTest, LeavesNothingWhereAFolderIsInTheWay) {
    fs::create_directory(path("a"));

    const Error error = catchError([&] { writeFileAtomically(path("a"), std::string("new")); });

    EXPECT_EQ(error.code(), ErrorCode::writeFailed);
    EXPECT_TRUE(fs::is_directory(path("a")));
    EXPECT_EQ(entryCount(), 1);
}

TEST_F(FileTest, SaysThatTheFolderToWriteToIsMissing) {
    const fs::path orphan = path("missing") / "a";

    for (const Error& error : {catchError([&] { writeFileAtomically(orphan, std::string("new")); }),
                               catchError([&] { checkWritable(orphan); })}) {
        EXPECT_EQ(error.code(), ErrorCode::writeFailed);
        EXPECT_EQ(error.where(), orphan.string());
        EXPECT_STREQ(error.what(), "cannot be written: No such file or directory");
    }
    EXPECT_EQ(entryCount(), 0);
}

TEST_F(FileTest, CheckingThatAFileCanBeWrittenChangesNothing) {
    checkWritable(path("new"));
    EXPECT_EQ(entryCount(), 0);

    writeText(path("a"), "old");
    checkWritable(path("a"));
    EXPECT_EQ(readText(path("a")), "old");
    EXPECT_EQ(entryCount(), 1);
}

TEST_F(FileTest, AFolderCannotBeWrittenAsAFile) {
    fs::create_directory(path("folder"));

    EXPECT_EQ(catchError([&] { checkWritable(path("folder")); }).code(), ErrorCode::writeFailed);
}

TEST_F(FileTest, ADeviceOrPipeIsNeverReplaced) {
    ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);

    EXPECT_EQ(catchError([&] { writeFileAtomically(path("pipe"), "text"); }).code(),
              ErrorCode::writeFailed);
    EXPECT_TRUE(fs::is_fifo(path("pipe")));
}

}  // namespace
}  // namespace prt

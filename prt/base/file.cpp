#include "prt/base/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "prt/base/error.h"

namespace prt {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void throwWriteFailed(const fs::path& path, int errorNumber) {
    throw Error(ErrorCode::writeFailed,
                std::string("cannot be written: ") + std::strerror(errorNumber), path.string(),
                "check that the folder exists, is writable and has space");
}

/// A rename over a folder fails late, and one over a device would remove it.
void checkReplaceable(const fs::path& path) {
    std::error_code ignored;
    const fs::file_status status = fs::status(path, ignored);
    if (fs::is_directory(status))
        throw Error(ErrorCode::writeFailed, "is a folder, not a file", path.string());
    if (fs::exists(status) && !fs::is_regular_file(status))
        throw Error(ErrorCode::writeFailed, "is a device or a pipe, not a file", path.string());
}

/// Makes a rename in the folder of a file durable; where folders cannot be flushed, no harm is
/// done.
void syncFolderOf(const fs::path& path) {
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY);
    if (descriptor < 0) return;
    ::fsync(descriptor);
    ::close(descriptor);
}

}  // namespace

std::vector<std::byte> readFile(const fs::path& path, std::uintmax_t maxBytes) {
    std::error_code failure;
    const fs::file_status status = fs::status(path, failure);
    if (!fs::exists(status)) throw Error(ErrorCode::notFound, "does not exist", path.string());
    if (!fs::is_regular_file(status))
        throw Error(ErrorCode::unreadable, "is not a file", path.string());
    const std::uintmax_t size = fs::file_size(path, failure);
    if (failure) throw Error(ErrorCode::unreadable, failure.message(), path.string());
    if (size > maxBytes)
        throw Error(ErrorCode::limitExceeded,
                    "has " + std::to_string(size) + " bytes, more than the limit of " +
                        std::to_string(maxBytes),
                    path.string());

    std::ifstream file(path, std::ios::binary);
    std::vector<std::byte> bytes(static_cast<std::size_t>(size));
    file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!file) throw Error(ErrorCode::unreadable, "could not be read to its end", path.string());
    return bytes;
}

AtomicFile::AtomicFile(const fs::path& destination) : destination_(destination) {
    checkReplaceable(destination);
    temporary_ = destination.string() + ".part-XXXXXX";
    descriptor_ = ::mkstemp(temporary_.data());
    if (descriptor_ < 0) throwWriteFailed(destination_, errno);
}

AtomicFile::~AtomicFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void AtomicFile::append(std::span<const std::byte> bytes) {
    size_ += bytes.size();
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) throwWriteFailed(destination_, errno);
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
}

void AtomicFile::commit() {
    requireSize();
    // mkstemp makes files private; give the result the mode an ordinary create would have.
    const mode_t mask = ::umask(0);
    ::umask(mask);
    if (::fchmod(descriptor_, 0666 & ~mask) != 0) throwWriteFailed(destination_, errno);
    if (::fsync(descriptor_) != 0) throwWriteFailed(destination_, errno);
    const int closed = ::close(descriptor_);
    descriptor_ = -1;
    if (closed != 0) throwWriteFailed(destination_, errno);
    if (::rename(temporary_.c_str(), destination_.c_str()) != 0)
        throwWriteFailed(destination_, errno);
    temporary_.clear();
    syncFolderOf(destination_);
}

void AtomicFile::requireSize() const {
    struct stat status = {};
    if (::fstat(descriptor_, &status) != 0) throwWriteFailed(destination_, errno);
    if (static_cast<std::uint64_t>(status.st_size) != size_)
        throw Error(ErrorCode::writeFailed, "cannot be written: some of its bytes were lost",
                    destination_.string());
}

void writeFileAtomically(const fs::path& path, std::span<const std::byte> bytes) {
    AtomicFile file(path);
    file.append(bytes);
    file.commit();
}

void writeFileAtomically(const fs::path& path, const std::string& text) {
    writeFileAtomically(path, std::as_bytes(std::span(text.data(), text.size())));
}

void checkWritable(const fs::path& path) {
    const AtomicFile probe(path);
}

}  // namespace prt

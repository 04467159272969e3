#include "prt/base/scratch_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

#include "prt/base/error.h"

namespace prt {
namespace {

[[noreturn]] void throwScratchError(ErrorCode code, const std::filesystem::path& folder) {
    throw Error(
        code,
        std::string("what does not fit in memory cannot be kept here: ") + std::strerror(errno),
        folder.string(), "allow more memory, or name another scratch folder");
}

}  // namespace

ScratchFile::ScratchFile(std::filesystem::path folder)
    : folder_(folder.empty() ? std::filesystem::temp_directory_path() : std::move(folder)) {
    std::string name = (folder_ / "openprt-scratch-XXXXXX").string();
    descriptor_ = ::mkostemp(name.data(), O_CLOEXEC);
    if (descriptor_ < 0) throwScratchError(ErrorCode::writeFailed, folder_);
    ::unlink(name.c_str());
}

ScratchFile::~ScratchFile() {
    ::close(descriptor_);
}

void ScratchFile::write(std::uint64_t offset, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t count =
            ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) throwScratchError(ErrorCode::writeFailed, folder_);
        offset += static_cast<std::uint64_t>(count);
        bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
}

void ScratchFile::read(std::uint64_t offset, std::span<std::byte> bytes) const {
    while (!bytes.empty()) {
        const ssize_t count =
            ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) throwScratchError(ErrorCode::unreadable, folder_);
        offset += static_cast<std::uint64_t>(count);
        bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
}

void ScratchFile::resize(std::uint64_t byteCount) {
    if (::ftruncate(descriptor_, static_cast<off_t>(byteCount)) != 0)
        throwScratchError(ErrorCode::writeFailed, folder_);
}

ScratchView::ScratchView(const ScratchFile& file, std::size_t byteCount) : byteCount_(byteCount) {
    void* const mapped = ::mmap(nullptr, byteCount, PROT_READ, MAP_SHARED, file.descriptor(), 0);
    if (mapped == MAP_FAILED)
        throw Error(ErrorCode::unreadable,
                    std::string("a scratch file cannot be mapped: ") + std::strerror(errno));
    data_ = static_cast<std::byte*>(mapped);
}

ScratchView::~ScratchView() {
    ::munmap(data_, byteCount_);
}

void ScratchView::release() const {
    ::madvise(data_, byteCount_, MADV_DONTNEED);
}

}  // namespace prt

#include "apps/prt/staged_folder.h"

#include <cstdlib>
#include <string>
#include <system_error>
#include <utility>

#include "prt/base/error.h"
#include "prt/base/file.h"

namespace prt::cli {
namespace {

namespace fs = std::filesystem;

/// Without a slash at its end, which would make its name empty.
fs::path withName(const fs::path& folder) {
    return folder.has_filename() ? folder : folder.parent_path();
}

}  // namespace

void StagedFolder::check(const fs::path& folder) {
    std::error_code ignored;
    const fs::path named = withName(folder);
    if (fs::exists(named, ignored) && !(fs::is_directory(named, ignored) && fs::is_empty(named)))
        throw Error(ErrorCode::invalidOption, "exists already", folder.string(),
                    "choose another name, or remove it first");
    checkWritable(named);
}

StagedFolder::StagedFolder(fs::path folder) : folder_(withName(folder)) {
    check(folder_);
    std::string name = folder_.string() + ".XXXXXX";
    if (!::mkdtemp(name.data()))
        throw Error(ErrorCode::writeFailed, "cannot be written", folder_.string());
    staging_ = name;
    // mkdtemp makes folders private; a report is for whoever may read its folder.
    std::error_code ignored;
    fs::permissions(staging_,
                    fs::perms::group_read | fs::perms::group_exec | fs::perms::others_read |
                        fs::perms::others_exec,
                    fs::perm_options::add, ignored);
}

StagedFolder::~StagedFolder() {
    std::error_code ignored;
    if (!staging_.empty()) fs::remove_all(staging_, ignored);
}

void StagedFolder::commit() {
    std::error_code failure;
    fs::rename(staging_, folder_, failure);
    if (failure)
        throw Error(ErrorCode::writeFailed, "cannot be written: " + failure.message(),
                    folder_.string());
    staging_.clear();
}

}  // namespace prt::cli

#include "prt/transport/checkpoint.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "prt/base/assert.h"
#include "prt/base/byte_stream.h"
#include "prt/base/checksum.h"
#include "prt/base/error.h"
#include "prt/base/file.h"
#include "prt/base/fingerprint.h"

namespace prt {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::array<char, 8> kUnitMagic = {'P', 'R', 'T', 'U', 'N', 'I', 'T', '\0'};
constexpr std::uint32_t kUnitVersion = 1;
constexpr std::size_t kUnitFrameBytes = 60;  // all but the payload
constexpr std::uintmax_t kMaxUnitBytes = std::uintmax_t(1) << 32;

constexpr const char* kManifestName = "manifest.json";
constexpr const char* kManifestKind = "OpenPRT checkpoint";
constexpr int kManifestVersion = 1;
constexpr std::uintmax_t kMaxManifestBytes = 1 << 20;

constexpr const char* kUnitSuffix = ".unit";
constexpr std::string_view kTemporaryMark = ".part-";

using StageName = std::array<char, kMaxStageBytes>;

StageName padStage(const std::string& stage) {
    PRT_ASSERT(!stage.empty() && stage.size() <= kMaxStageBytes, "the stage has a short name");
    StageName padded = {};
    std::copy(stage.begin(), stage.end(), padded.begin());
    return padded;
}

std::string unitFileName(const UnitKey& key) {
    std::string digits = std::to_string(key.index);
    digits.insert(0, digits.size() < 6 ? 6 - digits.size() : 0, '0');
    return key.stage + "-" + digits + kUnitSuffix;
}

bool isOfACheckpoint(const std::string& fileName) {
    return fileName == kManifestName || fileName.ends_with(kUnitSuffix);
}

/// What writeFileAtomically leaves behind when the process is killed.
bool isTemporary(const std::string& fileName) {
    const std::size_t mark = fileName.rfind(kTemporaryMark);
    return mark != std::string::npos && isOfACheckpoint(fileName.substr(0, mark));
}

/// The names of what lies in a folder.
std::vector<std::string> listFolder(const fs::path& folder) {
    std::error_code failure;
    std::vector<std::string> names;
    fs::directory_iterator entry(folder, failure);
    for (; !failure && entry != fs::directory_iterator(); entry.increment(failure))
        names.push_back(entry->path().filename().string());
    if (failure) throw Error(ErrorCode::unreadable, failure.message(), folder.string());
    return names;
}

void makeFolder(const fs::path& folder) {
    std::error_code failure;
    fs::create_directories(folder, failure);
    if (failure || !fs::is_directory(folder, failure))
        throw Error(ErrorCode::writeFailed,
                    "cannot be made: " + (failure ? failure.message() : "it is no folder"),
                    folder.string(), "name a folder for the checkpoint that can be made");
}

bool isPrintable(const std::string& text) {
    return std::all_of(text.begin(), text.end(),
                       [](char letter) { return letter >= ' ' && letter <= '~'; });
}

/// "samples: 1024 in the checkpoint, 512 asked for", of all settings that differ.
std::string describeDifferences(const std::vector<Setting>& kept,
                                const std::vector<Setting>& asked) {
    const auto valueIn = [](const std::vector<Setting>& settings, const std::string& name) {
        const auto found = std::find_if(settings.begin(), settings.end(),
                                        [&](const Setting& each) { return each.name == name; });
        return found == settings.end() ? std::string("nothing") : found->value;
    };
    std::vector<Setting> all = asked;
    for (const Setting& setting : kept)
        if (valueIn(asked, setting.name) == "nothing") all.push_back(setting);
    std::string text;
    for (const Setting& setting : all) {
        const std::string before = valueIn(kept, setting.name);
        const std::string now = valueIn(asked, setting.name);
        if (before == now) continue;
        text += (text.empty() ? "" : "; ") + setting.name + ": " + before + " in the checkpoint, " +
                now + " asked for";
    }
    return text;
}

void requireSameSettings(const fs::path& folder, const std::vector<Setting>& asked) {
    const std::vector<Setting> kept = readFolderSettings(folder);
    if (kept == asked) return;
    throw Error(ErrorCode::invalidOption,
                "was begun with other settings, " + describeDifferences(kept, asked),
                folder.string(), "ask for the same, or name a new folder");
}

/// Writes the manifest of a new folder, or finds the same in an old one.
void beginOrResume(const fs::path& folder, const std::vector<Setting>& settings) {
    // In this order, for another process may be beginning the same work.
    const std::vector<std::string> names = listFolder(folder);
    const bool isEmpty = std::all_of(names.begin(), names.end(), isTemporary);
    std::error_code ignored;
    if (fs::exists(folder / kManifestName, ignored)) return requireSameSettings(folder, settings);
    if (!isEmpty)
        throw Error(ErrorCode::invalidOption,
                    "holds files but no manifest.json, so it is no checkpoint", folder.string(),
                    "name a new or an empty folder");
    writeFileAtomically(folder / kManifestName, encodeManifest(settings));
}

}  // namespace

std::vector<std::byte> encodeUnit(std::uint64_t workFingerprint, const UnitKey& key,
                                  std::span<const std::byte> payload) {
    ByteWriter writer(kUnitFrameBytes + payload.size());
    writer.write(std::span<const char>(kUnitMagic));
    writer.writeNumber(kUnitVersion);
    writer.writeNumber(key.index);
    writer.writeNumber(workFingerprint);
    writer.write(std::span<const char>(padStage(key.stage)));
    writer.writeNumber(key.begin);
    writer.writeNumber(key.end);
    writer.write(payload);
    writer.writeNumber(computeCrc32(writer.bytes()));
    return writer.takeBytes();
}

std::span<const std::byte> readUnit(std::span<const std::byte> bytes, std::uint64_t workFingerprint,
                                    const UnitKey& key) {
    const auto fail = [](const char* what) { throw Error(ErrorCode::malformed, what); };
    // Whatever happened to the file, its checksum tells; a file cut short has none.
    std::uint32_t checksum = 0;
    if (bytes.size() < sizeof(checksum)) fail("is cut short");
    const std::span<const std::byte> checked = bytes.first(bytes.size() - sizeof(checksum));
    checksum = ByteReader(bytes.subspan(checked.size())).readNumber<std::uint32_t>();
    if (computeCrc32(checked) != checksum) fail("is damaged: its checksum is another");

    ByteReader reader(checked);
    if (!std::ranges::equal(reader.readVector<char>(kUnitMagic.size()), kUnitMagic))
        fail("is no unit of a checkpoint");
    if (reader.readNumber<std::uint32_t>() != kUnitVersion) fail("has another version");
    const bool sameIndex = reader.readNumber<std::uint32_t>() == key.index;
    if (reader.readNumber<std::uint64_t>() != workFingerprint) fail("belongs to another bake");
    const bool sameStage =
        std::ranges::equal(reader.readVector<char>(kMaxStageBytes), padStage(key.stage));
    const bool sameBegin = reader.readNumber<std::uint64_t>() == key.begin;
    const bool sameEnd = reader.readNumber<std::uint64_t>() == key.end;
    if (!sameIndex || !sameStage || !sameBegin || !sameEnd)
        fail("is another unit than its name says");
    return checked.last(reader.remainingBytes());
}

std::string encodeManifest(std::span<const Setting> settings) {
    Json values = Json::object();
    for (const Setting& setting : settings)
        values[setting.name] = setting.value;
    const Json manifest = {
        {"kind", kManifestKind}, {"version", kManifestVersion}, {"settings", values}};
    return manifest.dump(2) + "\n";
}

std::vector<Setting> readManifest(std::span<const std::byte> bytes) {
    const auto* text = reinterpret_cast<const char*>(bytes.data());
    const Json manifest = Json::parse(text, text + bytes.size(), nullptr, false);
    if (!manifest.is_object() || manifest.value("kind", Json()) != kManifestKind)
        throw Error(ErrorCode::malformed, "is no manifest of a checkpoint");
    if (manifest.value("version", Json()) != kManifestVersion)
        throw Error(ErrorCode::unsupported, "has a version that this program does not know");
    const Json values = manifest.value("settings", Json());
    if (!values.is_object()) throw Error(ErrorCode::malformed, "has no settings");
    std::vector<Setting> settings;
    for (const auto& [name, value] : values.items()) {
        if (!value.is_string() || !isPrintable(name) || !isPrintable(value.get<std::string>()))
            throw Error(ErrorCode::malformed, "has a setting that is no text");
        settings.push_back({name, value.get<std::string>()});
    }
    return settings;
}

std::vector<Setting> readFolderSettings(const fs::path& folder) {
    const fs::path path = folder / kManifestName;
    std::error_code ignored;
    if (!fs::exists(path, ignored))
        throw Error(ErrorCode::notFound, "holds no checkpoint", folder.string(),
                    "name a folder that was given to prt bake --checkpoint");
    try {
        return readManifest(readFile(path, kMaxManifestBytes));
    } catch (const Error& error) {
        throw Error(error.code(), error.what(), path.string(), "remove the folder to begin again");
    }
}

/// A mark on the folder that it is being worked in, which the system removes however the process
/// ends. Who comes into an empty room sweeps it.
class Checkpoint::Presence {
  public:
    explicit Presence(const fs::path& folder)
        : descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
        if (descriptor_ < 0) return;
        if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) sweep(folder);
        while (::flock(descriptor_, LOCK_SH) != 0 && errno == EINTR) {
        }
    }
    ~Presence() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }
    Presence(const Presence&) = delete;
    Presence& operator=(const Presence&) = delete;

  private:
    static void sweep(const fs::path& folder) {
        std::error_code ignored;
        for (const std::string& name : listFolder(folder))
            if (isTemporary(name)) fs::remove(folder / name, ignored);
    }

    int descriptor_;
};

Checkpoint::Checkpoint(const fs::path& folder, const std::vector<fs::path>& otherFolders,
                       const std::vector<Setting>& settings)
    : folders_{folder} {
    makeFolder(folder);
    presence_ = std::make_unique<Presence>(folder);
    beginOrResume(folder, settings);
    for (const fs::path& other : otherFolders) {
        requireSameSettings(other, settings);
        folders_.push_back(other);
    }
    const std::string manifest = encodeManifest(settings);
    Fingerprint fingerprint;
    fingerprint.add(std::as_bytes(std::span(manifest)));
    workFingerprint_ = fingerprint.value();
}

Checkpoint::~Checkpoint() = default;

bool Checkpoint::load(const UnitKey& key,
                      const std::function<void(std::span<const std::byte> payload)>& parse) {
    for (const fs::path& folder : folders_) {
        const fs::path path = folder / unitFileName(key);
        try {
            const std::vector<std::byte> bytes = readFile(path, kMaxUnitBytes);
            parse(readUnit(bytes, workFingerprint_, key));
            return true;
        } catch (const Error& error) {
            if (error.code() == ErrorCode::notFound) continue;
            const std::lock_guard lock(warning_);
            warnings_.push_back(path.string() + ": " + error.what() + "; it is not used");
        }
    }
    return false;
}

bool Checkpoint::contains(const UnitKey& key) const {
    return std::any_of(folders_.begin(), folders_.end(), [&](const fs::path& folder) {
        std::error_code ignored;
        return fs::exists(folder / unitFileName(key), ignored);
    });
}

void Checkpoint::store(const UnitKey& key, std::span<const std::byte> payload) {
    writeFileAtomically(folders_.front() / unitFileName(key),
                        encodeUnit(workFingerprint_, key, payload));
}

std::vector<std::string> Checkpoint::warnings() const {
    const std::lock_guard lock(warning_);
    std::vector<std::string> sorted = warnings_;
    std::sort(sorted.begin(), sorted.end());
    return sorted;
}

}  // namespace prt

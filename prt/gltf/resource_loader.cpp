#include "prt/gltf/resource_loader.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <span>
#include <string>
#include <string_view>
#include <system_error>

#include "prt/base/error.h"
#include "prt/base/file.h"

namespace prt::gltf {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kDataScheme = "data:";
constexpr std::string_view kBase64Marker = ";base64";

/// The value of a base64 digit, or −1 [RFC 4648, table 1].
int base64Digit(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+') return 62;
    return c == '/' ? 63 : -1;
}

std::vector<std::byte> decodeBase64(std::string_view text, const JsonCursor& uri) {
    while (!text.empty() && text.size() % 4 != 1 && text.back() == '=')
        text.remove_suffix(1);
    if (text.size() % 4 == 1) uri.reject("holds base64 text of a wrong length");

    std::vector<std::byte> bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t bits = 0;
    int bitCount = 0;
    for (const char c : text) {
        const int digit = base64Digit(c);
        if (digit < 0) uri.reject("holds a character that is not base64");
        bits = (bits << 6) | static_cast<std::uint32_t>(digit);
        bitCount += 6;
        if (bitCount < 8) continue;
        bitCount -= 8;
        bytes.push_back(static_cast<std::byte>((bits >> bitCount) & 0xff));
    }
    return bytes;
}

int hexDigit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/// Replaces each %XX by its byte [RFC 3986, 2.1].
std::string decodePercents(std::string_view text, const JsonCursor& uri) {
    std::string decoded;
    decoded.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            decoded += text[i];
            continue;
        }
        const int high = i + 2 < text.size() ? hexDigit(text[i + 1]) : -1;
        const int low = i + 2 < text.size() ? hexDigit(text[i + 2]) : -1;
        if (high < 0 || low < 0) uri.reject("has a % that is not followed by two digits");
        decoded += static_cast<char>(high * 16 + low);
        i += 2;
    }
    return decoded;
}

/// `data:[<media type>][;base64],<data>` [RFC 2397]
std::vector<std::byte> decodeDataUri(const JsonCursor& uri) {
    const std::string_view text = uri.toString();
    const std::size_t comma = text.find(',');
    const std::string_view mediaType = text.substr(0, comma);
    if (comma == std::string_view::npos || mediaType.find(";;") != std::string_view::npos)
        uri.reject("is not a data URI");
    const std::string_view data = text.substr(comma + 1);
    if (mediaType.ends_with(kBase64Marker)) return decodeBase64(data, uri);
    const std::string decoded = decodePercents(data, uri);
    const auto bytes = std::as_bytes(std::span(decoded));
    return {bytes.begin(), bytes.end()};
}

[[noreturn]] void refuseOutside(const JsonCursor& uri) {
    throw Error(ErrorCode::unsupported, uri.place() + " names something outside the file's folder",
                {}, "put the buffers and images beside the glTF or below it");
}

/// Whether a path begins with a scheme ("file:", "http:") or a drive letter.
bool hasScheme(std::string_view path) {
    const std::size_t colon = path.find(':');
    return colon != std::string_view::npos && colon < path.find('/');
}

/// Whether any part of a path between slashes is "..".
bool climbs(const fs::path& path) {
    return std::find(path.begin(), path.end(), fs::path("..")) != path.end();
}

bool liesWithin(const fs::path& folder, const fs::path& file) {
    const auto [folderEnd, fileEnd] =
        std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
    return folderEnd == folder.end();
}

}  // namespace

fs::path ResourceLoader::resolve(const JsonCursor& uri) const {
    const std::string name = decodePercents(uri.toString(), uri);
    const auto isControl = [](unsigned char c) { return std::iscntrl(c) != 0; };
    if (name.empty() || std::any_of(name.begin(), name.end(), isControl))
        uri.reject("is not a file's name");
    if (name.front() == '/' || name.find('\\') != std::string::npos || hasScheme(name))
        refuseOutside(uri);
    const fs::path relative(std::u8string(name.begin(), name.end()));
    if (relative.is_absolute() || climbs(relative)) refuseOutside(uri);

    // A symbolic link may still point anywhere: compare what the two really are.
    std::error_code failure;
    const fs::path base = folder_.empty() ? fs::path(".") : folder_;
    const fs::path folder = fs::canonical(base, failure);
    const fs::path file = fs::weakly_canonical(base / relative, failure);
    if (failure) throw Error(ErrorCode::unreadable, failure.message(), (base / relative).string());
    if (!liesWithin(folder, file)) refuseOutside(uri);
    return file;
}

std::vector<std::byte> ResourceLoader::load(const JsonCursor& uri) {
    std::vector<std::byte> bytes = uri.toString().starts_with(kDataScheme)
                                       ? decodeDataUri(uri)
                                       : readFile(resolve(uri), byteBudget_);
    if (bytes.size() > byteBudget_)
        throw Error(ErrorCode::limitExceeded,
                    uri.place() + " has " + std::to_string(bytes.size()) + " bytes, and only " +
                        std::to_string(byteBudget_) + " are left of the limit for all files");
    byteBudget_ -= bytes.size();
    return bytes;
}

}  // namespace prt::gltf

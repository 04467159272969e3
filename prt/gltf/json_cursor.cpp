#include "prt/gltf/json_cursor.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "prt/base/error.h"

namespace prt::gltf {
namespace {

constexpr std::size_t kMaxJsonBytes = std::size_t(64) << 20;
constexpr int kMaxJsonDepth = 64;
/// From here on doubles, and so JSON's readers, no longer tell whole numbers apart: 2^53.
constexpr double kWholeNumberLimit = 9007199254740992.0;

/// How many brackets and braces are open at once; those within strings do not count.
int nestingDepth(std::string_view text) {
    int depth = 0;
    int deepest = 0;
    bool isString = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '"') isString = !isString;
        if (isString && c == '\\') ++i;
        if (isString) continue;
        if (c == '[' || c == '{') deepest = std::max(deepest, ++depth);
        if (c == ']' || c == '}') --depth;
    }
    return deepest;
}

}  // namespace

Json parseJson(std::string_view text) {
    if (text.size() > kMaxJsonBytes)
        throw Error(ErrorCode::limitExceeded, "has more than 64 MiB of JSON", {},
                    "keep its buffers in files of their own or in a .glb");
    if (nestingDepth(text) > kMaxJsonDepth)
        throw Error(ErrorCode::limitExceeded, "nests its JSON more than 64 levels deep");
    // The parser would end at a zero, and not see what follows.
    if (text.find('\0') != std::string_view::npos)
        throw Error(ErrorCode::malformed, "has a zero byte in its JSON");
    try {
        return Json::parse(text.begin(), text.end());
    } catch (const Json::parse_error& error) {
        throw Error(ErrorCode::malformed,
                    "is not valid JSON at byte " + std::to_string(error.byte));
    } catch (const Json::exception&) {
        throw Error(ErrorCode::malformed, "holds a number that no double can hold");
    }
}

void JsonCursor::reject(const std::string& complaint) const {
    throw Error(ErrorCode::malformed, place_ + " " + complaint);
}

std::optional<JsonCursor> JsonCursor::find(const char* key) const {
    if (!value_->is_object()) reject("must be an object");
    const auto member = value_->find(key);
    if (member == value_->end()) return std::nullopt;
    return JsonCursor(*member, place_.empty() ? key : place_ + "." + key);
}

JsonCursor JsonCursor::at(const char* key) const {
    std::optional<JsonCursor> member = find(key);
    if (!member) reject(std::string("lacks \"") + key + "\"");
    return *std::move(member);
}

std::size_t JsonCursor::size() const {
    if (!value_->is_array()) reject("must be an array");
    return value_->size();
}

JsonCursor JsonCursor::operator[](std::size_t i) const {
    return {(*value_)[i], place_ + "[" + std::to_string(i) + "]"};
}

std::vector<std::pair<std::string, JsonCursor>> JsonCursor::members() const {
    if (!value_->is_object()) reject("must be an object");
    std::vector<std::pair<std::string, JsonCursor>> members;
    for (const auto& [key, value] : value_->items())
        members.emplace_back(key, JsonCursor(value, place_ + "." + key));
    return members;
}

double JsonCursor::toNumber() const {
    if (!value_->is_number()) reject("must be a number");
    return value_->get<double>();
}

bool JsonCursor::toBool() const {
    if (!value_->is_boolean()) reject("must be true or false");
    return value_->get<bool>();
}

const std::string& JsonCursor::toString() const {
    if (!value_->is_string()) reject("must be a string");
    return value_->get_ref<const std::string&>();
}

std::size_t JsonCursor::toCount() const {
    const double number = toNumber();
    if (!(number >= 0.0 && number < kWholeNumberLimit && number == std::floor(number)))
        reject("must be a whole number from 0 to 2^53");
    return static_cast<std::size_t>(number);
}

std::size_t JsonCursor::toIndex(std::size_t count, const char* things) const {
    const std::size_t index = toCount();
    if (index >= count)
        reject("is " + std::to_string(index) + ", but the file has " + std::to_string(count) + " " +
               things);
    return index;
}

double JsonCursor::numberOr(const char* key, double fallback) const {
    const std::optional<JsonCursor> member = find(key);
    return member ? member->toNumber() : fallback;
}

bool JsonCursor::boolOr(const char* key, bool fallback) const {
    const std::optional<JsonCursor> member = find(key);
    return member ? member->toBool() : fallback;
}

std::string JsonCursor::stringOr(const char* key, const std::string& fallback) const {
    const std::optional<JsonCursor> member = find(key);
    return member ? member->toString() : fallback;
}

std::size_t JsonCursor::countOr(const char* key, std::size_t fallback) const {
    const std::optional<JsonCursor> member = find(key);
    return member ? member->toCount() : fallback;
}

std::optional<std::size_t> JsonCursor::findIndex(const char* key, std::size_t count,
                                                 const char* things) const {
    const std::optional<JsonCursor> member = find(key);
    if (!member) return std::nullopt;
    return member->toIndex(count, things);
}

std::string JsonCursor::dump() const {
    return value_->dump();
}

std::size_t countElements(const JsonCursor& object, const char* key) {
    const std::optional<JsonCursor> list = object.find(key);
    return list ? list->size() : 0;
}

}  // namespace prt::gltf

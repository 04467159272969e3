#include "prt/io/ply_body.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "prt/base/error.h"
#include "prt/io/text_parsing.h"

namespace prt {
namespace {

static_assert(std::endian::native == std::endian::little);

[[noreturn]] void fail(const std::string& what, const std::string& name) {
    throw Error(ErrorCode::malformed, what, name);
}

[[noreturn]] void failEarlyEnd(const std::string& name) {
    fail("is a PLY file that ends too early", name);
}

template <class Integer>
bool holds(double value) {
    return value >= double(std::numeric_limits<Integer>::min()) &&
           value <= double(std::numeric_limits<Integer>::max());
}

bool isInRange(PlyType type, double value) {
    switch (type) {
        case PlyType::int8:
            return holds<std::int8_t>(value);
        case PlyType::uint8:
            return holds<std::uint8_t>(value);
        case PlyType::int16:
            return holds<std::int16_t>(value);
        case PlyType::uint16:
            return holds<std::uint16_t>(value);
        case PlyType::int32:
            return holds<std::int32_t>(value);
        case PlyType::uint32:
            return holds<std::uint32_t>(value);
        case PlyType::float32:
        case PlyType::float64:
            break;
    }
    return true;
}

}  // namespace

template <class Number>
double PlyBody::readBinary() {
    std::array<char, sizeof(Number)> bytes;
    if (rest_.size() < bytes.size()) failEarlyEnd(name_);
    std::copy_n(rest_.begin(), bytes.size(), bytes.begin());
    rest_.remove_prefix(bytes.size());
    if (format_ == PlyFormat::bigEndian) std::reverse(bytes.begin(), bytes.end());
    return static_cast<double>(std::bit_cast<Number>(bytes));
}

double PlyBody::readWord(PlyType type) {
    const std::string_view word = takeWord(rest_);
    if (word.empty()) failEarlyEnd(name_);
    const std::optional<double> value = parseNumber<double>(word);
    if (!value) fail("holds a word where PLY has a number", name_);
    if (isPlyInteger(type) && (*value != std::floor(*value) || !isInRange(type, *value)))
        fail("holds a number that does not fit the type of its property", name_);
    return *value;
}

double PlyBody::readNumber(PlyType type) {
    if (format_ == PlyFormat::ascii) return readWord(type);
    switch (type) {
        case PlyType::int8:
            return readBinary<std::int8_t>();
        case PlyType::uint8:
            return readBinary<std::uint8_t>();
        case PlyType::int16:
            return readBinary<std::int16_t>();
        case PlyType::uint16:
            return readBinary<std::uint16_t>();
        case PlyType::int32:
            return readBinary<std::int32_t>();
        case PlyType::uint32:
            return readBinary<std::uint32_t>();
        case PlyType::float32:
            return readBinary<float>();
        case PlyType::float64:
            break;
    }
    return readBinary<double>();
}

std::size_t PlyBody::readListCount(const PlyProperty& list) {
    const double count = readNumber(list.countType);
    if (count < 0.0) fail("has a list of negative length", name_);
    const std::size_t itemBytes = format_ == PlyFormat::ascii ? 1 : plyTypeBytes(list.type);
    if (count > double(rest_.size() / itemBytes)) failEarlyEnd(name_);
    return static_cast<std::size_t>(count);
}

void PlyBody::skip(const PlyProperty& property) {
    const std::size_t count = property.isList ? readListCount(property) : 1;
    for (std::size_t i = 0; i < count; ++i)
        readNumber(property.type);
}

std::size_t PlyBody::minBytes(const PlyProperty& property) const {
    if (format_ == PlyFormat::ascii) return 1;
    return plyTypeBytes(property.isList ? property.countType : property.type);
}

void PlyBody::checkCount(const PlyElement& element) const {
    std::size_t bytesEach = 0;
    for (const PlyProperty& property : element.properties)
        bytesEach += minBytes(property);
    if (element.count > rest_.size() / std::max<std::size_t>(bytesEach, 1))
        fail("is too short for the " + std::to_string(element.count) + " \"" + element.name +
                 "\" that its PLY header claims",
             name_);
}

}  // namespace prt

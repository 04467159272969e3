#include "prt/io/text_parsing.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace prt {

std::optional<std::string_view> LineReader::next() {
    if (rest_.empty()) return std::nullopt;
    ++lineNumber_;
    const std::size_t end = rest_.find_first_of("\r\n");
    const std::string_view line = rest_.substr(0, end);
    if (end == std::string_view::npos) {
        rest_ = {};
        return line;
    }
    rest_.remove_prefix(end + (rest_.substr(end).starts_with("\r\n") ? 2 : 1));
    return line;
}

std::string_view takeWord(std::string_view& text) {
    constexpr std::string_view kBlanks = " \t\r\n\v\f";
    text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
    const std::string_view word = text.substr(0, text.find_first_of(kBlanks));
    text.remove_prefix(word.size());
    return word;
}

std::string_view trim(std::string_view text) {
    constexpr std::string_view kBlanks = " \t";
    text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
    return text.substr(0, text.find_last_not_of(kBlanks) + 1);
}

std::optional<float> parseFiniteFloat(std::string_view word) {
    // Through double: a float's own range error would refuse numbers that are merely tiny.
    const std::optional<double> number = parseNumber<double>(word);
    if (!number || !(std::abs(*number) <= std::numeric_limits<float>::max())) return std::nullopt;
    return static_cast<float>(*number);
}

}  // namespace prt

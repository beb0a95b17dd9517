#pragma once

#include <string_view>

namespace pleat::demo {

/// Some editors put it in front of a text in UTF-8. It means nothing.
inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

}  // namespace pleat::demo

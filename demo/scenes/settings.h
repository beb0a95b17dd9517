#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "engine/pleat.h"

namespace pleat::demo {

/// A word for a value of an enumeration.
struct SettingWord {
  std::string_view name;
  uint32_t value;
};

/// A field of pleat_cloth_settings by its name.
struct Setting {
  std::string_view name;
  std::variant<float pleat_cloth_settings::*, uint32_t pleat_cloth_settings::*> field;
  std::span<const SettingWord> words = {};  ///< the only values, where there are any
};

extern const std::span<const Setting> kSettings;
extern const std::span<const SettingWord> kIntegrators;
extern const std::span<const SettingWord> kSurfaces;
extern const std::span<const SettingWord> kLevels;
extern const std::span<const SettingWord> kFabrics;

/// Sets one field from text, as in `--set stiffness=60` or `"surface": "paper"`. Ranges are the engine's business.
/// Throws std::invalid_argument with a line that names what is known.
void set_setting(pleat_cloth_settings& settings, std::string_view name, std::string_view text);

/// The same from the words `key=value` of an option `--set`. Throws InputError.
void apply_option(const std::string& assignment, pleat_cloth_settings& into);

}  // namespace pleat::demo

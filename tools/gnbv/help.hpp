// What --help prints, and what a mistyped word may have meant.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace gnbv {

/// Its commands, or those of a command.
std::vector<CLI::App*> parts_of(CLI::App& app);

/// Help of all commands in lines of at most 80 columns, each with examples at its end. To be called
/// when all commands have their options.
void lay_out_help(CLI::App& app);

/// Of the first of the words (argv without the program) that is no command, or no part of the
/// command before it: "did you mean `gnbv render`?" where it resembles one, else that it is none.
/// Else the same of an option, if it resembles one; else empty.
std::string meant_instead(const CLI::App& app, std::span<const std::string> words);

}  // namespace gnbv

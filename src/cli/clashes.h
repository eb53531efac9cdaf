// Names on the command line that lead to one file: an output would take the place of what is read, or of another
// output.
#pragma once

#include <string>
#include <vector>

#include "cli/arguments.h"

namespace shodo {

/// False, and `mistake` one line, if an output is a file that is read, or another output by another name, or lies in
/// the folder that is an output. Links are followed; standard output, devices and pipes may be named as one likes.
/// `inputs`: those of the command line, and when a scene has been loaded those that it names.
bool outputs_apart(const Arguments& arguments, const std::vector<std::string>& inputs, std::string& mistake);

}  // namespace shodo

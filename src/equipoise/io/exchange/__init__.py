"""Mass properties in the files of other tools: written for simulators, read from CAD programs."""

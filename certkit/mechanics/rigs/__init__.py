"""The fixtures of a rig, each one small file, named in procedures by the words of `definitions.rig`."""

"""The fixtures of a rig: each one small file, named in a procedure by the words of `certkit.definitions.rig`."""

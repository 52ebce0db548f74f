"""What is read off a run: channels, motion, the energy balance, and what the vehicle front did."""

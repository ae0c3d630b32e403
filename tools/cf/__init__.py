"""What tools/cf.py is made of: a Crazyflie that runs the app, from the laptop."""

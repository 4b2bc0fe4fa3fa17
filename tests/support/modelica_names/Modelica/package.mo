package Modelica "Stand-in for the few names of the Modelica Standard Library that PyImu uses"
  package Icons
    partial class Information end Information;
    partial package Package end Package;
    partial package ExamplesPackage end ExamplesPackage;
    partial package InterfacesPackage end InterfacesPackage;
    partial package IconsPackage end IconsPackage;
    partial model Example end Example;
    partial function Function end Function;
  end Icons;
  package Constants
    constant Real pi = 3.141592653589793;
  end Constants;
  package Units
    package SI
      type Time = Real(quantity="Time", unit="s");
      type Angle = Real(quantity="Angle", unit="rad");
      type AngularVelocity = Real(quantity="AngularVelocity", unit="rad/s");
      type Acceleration = Real(quantity="Acceleration", unit="m/s2");
      type Velocity = Real(quantity="Velocity", unit="m/s");
      type Length = Real(quantity="Length", unit="m");
    end SI;
  end Units;
  package Utilities
    package Strings
      function hashString
        input String string;
        output Integer hash;
      algorithm
        hash := 0;
      end hashString;
    end Strings;
  end Utilities;
  package Blocks
    package Interfaces
      connector RealInput = input Real;
      connector RealOutput = output Real;
      connector BooleanInput = input Boolean;
      connector BooleanOutput = output Boolean;
      connector IntegerOutput = output Integer;
    end Interfaces;
  end Blocks;
end Modelica;
